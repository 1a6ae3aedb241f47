"""The long description of the package: README.md without links and pictures that need the files of a clone."""

import re
from pathlib import Path

from setuptools import setup

HERE = Path(__file__).parent


def for_a_wheel(text: str) -> str:
    """Text with its pictures as captions and its relative links as plain words; links to hosts stay."""
    text = re.sub(r"!\[([^]]*)\]\((?!https?:)[^)]*\)", r"*Picture in the source: \1.*", text)
    return re.sub(r"\[([^]]*)\]\((?!https?:)[^)]*\)", r"\1", text)


if __name__ == "__main__":
    readme = (HERE / "README.md").read_text(encoding="utf-8")
    setup(long_description=for_a_wheel(readme), long_description_content_type="text/markdown")
