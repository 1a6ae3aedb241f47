"""Case folders of real recordings: typed-in tables, and larger files from a folder of recordings.

python examples/real/build.py --out out/real
python examples/real/build.py --data ../shared/data/recordings --out out/real
"""

from __future__ import annotations

import argparse
from pathlib import Path

from from_files import FROM_FILES
from typed_in import TYPED_IN

from mixedlub.importers import write_case


def build(out: Path, data: Path | None = None) -> list[Path]:
    """Write every case; those made from larger files only where ``data`` holds them."""
    made = [write_case(out / name, system, columns) for make in TYPED_IN for name, system, columns in make()]
    for make in FROM_FILES if data is not None else ():
        made += [write_case(out / name, system, columns) for name, system, columns in make(data)]
    return made


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, help="folder of the recordings, for the larger files")
    parser.add_argument("--out", type=Path, default=Path("out/real"), help="where the case folders go")
    arguments = parser.parse_args()
    for folder in build(arguments.out, arguments.data):
        print(folder)
