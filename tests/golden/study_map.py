"""The golden map: every number of the shipped study's 378 conditions, as the code computed it when it was last checked.

python tests/golden/study_map.py        writes study_21_pairings.csv anew; look at `git diff` before it is committed
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from mixedlub.study import read_study, run_study

HERE = Path(__file__).resolve().parent
MAP = HERE / "study_21_pairings.csv"
STUDY = HERE.parents[1] / "examples" / "study_21_pairings.toml"


def computed() -> pd.DataFrame:
    """The table of the shipped study as the code computes it now."""
    return pd.concat([table.to_pandas() for table in run_study(read_study(STUDY)).tables()], ignore_index=True)


if __name__ == "__main__":
    computed().to_csv(MAP, index=False, float_format="%.12g", lineterminator="\n")
    print(f"{MAP}: {sum(1 for _ in MAP.open()) - 1} conditions")
