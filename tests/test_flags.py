"""A key that is true or false takes no word and no number for it, in any file."""

import importlib
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest
from pydantic import TypeAdapter, ValidationError

import mixedlub
from mixedlub.schema.section import Section

PACKAGE = Path(mixedlub.__file__).parent


def _sections(of: type[Section] = Section) -> Iterator[type[Section]]:
    for one in of.__subclasses__():
        yield one
        yield from _sections(one)


def _is_flag(annotation: object) -> bool:
    return annotation is bool or any(map(_is_flag, get_args(annotation)))


@pytest.fixture(scope="module")
def flags() -> dict[str, TypeAdapter]:
    """Every flag of every table of every file."""
    for path in sorted(PACKAGE.rglob("*.py")):
        if "(Section)" in path.read_text(encoding="utf-8"):
            importlib.import_module(".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts))
    return {
        f"{section.__name__}.{name}": TypeAdapter(field.rebuild_annotation())
        for section in _sections()
        for name, field in section.model_fields.items()
        if _is_flag(field.annotation)
    }


@pytest.mark.parametrize("value", ["yes", "true", "false", 1, 0.0])
def test_a_flag_is_true_or_false(flags, value):
    assert {"TwoDiscFile.traction_part", "EhlFile.thermal", "SurfaceSection.edges"} <= set(flags)
    for name, flag in flags.items():
        with pytest.raises(ValidationError) as refused:
            flag.validate_python(value)
        assert {one["type"] for one in refused.value.errors()} == {"bool_type"}, name
        assert flag.validate_python(True) is True
