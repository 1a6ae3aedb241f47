"""A law of a file as an effect: its function, its quantities in units, and its page."""

from __future__ import annotations

import inspect
import re
import tomllib
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.plain_text import GREEK
from mixedlub.chain.priors import Normal, Prior
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.effects import catalogue
from mixedlub.expressions import Call, Expression, parse
from mixedlub.expressions.latex import latex, symbol_in_latex
from mixedlub.own_laws.file import Ends, LawFile, LawParameter
from mixedlub.schema.past import Past, past_of
from mixedlub.schema.toml_file import parse as parse_toml
from mixedlub.schema.toml_file import read_toml
from mixedlub.schema.units import ENDINGS, dimension, ending_of, tidy, to_si, without_unit
from profiles.errors import InputError, nearest

IN_OTHER_WORDS = {"speed": "pinion_speed"}
"""Columns, without unit, and the name of their quantity in the glossary."""
VERBS = {"factor": "times", "add": "plus", "replace": "is"}
_GREEK = re.compile("|".join(rf"(?<![A-Za-z]){name}(?![A-Za-z])" for name in GREEK))


class Read(NamedTuple):
    """A quantity that the expression reads: its argument, and the factor and offset from the expression to SI."""

    argument: str
    factor: float = 1.0
    added: float = 0.0


class FileLaw:
    """The function of a law of a file: quantities in SI, and parameters in the units of the file."""

    def __init__(
        self,
        file: LawFile,
        text: str,
        path: Path,
        expression: Expression,
        reads: Mapping[str, Read],
        units: Mapping[str, Read],
    ) -> None:
        self.file, self.path, self.expression, self.reads, self.units = file, path, expression, reads, units
        self.text = text
        self.arguments = tuple(dict.fromkeys((file.acts_on, *(read.argument for read in reads.values()))))
        kinds = inspect.Parameter
        self.__signature__ = inspect.Signature(
            [
                *(kinds(name, kinds.POSITIONAL_OR_KEYWORD) for name in self.arguments),
                *(kinds(name, kinds.KEYWORD_ONLY) for name in units),
            ]
        )
        self.__name__ = file.id
        self.__doc__ = file.description or f"{file.acts_on} {VERBS[file.form]} {file.expression}."

    def expression_at(self, state: Mapping[str, Any], values: Mapping[str, float]) -> np.ndarray:
        """Values of the expression."""
        own: dict[str, Any] = {
            name: (np.asarray(state[read.argument]) - read.added) / read.factor for name, read in self.reads.items()
        }
        own |= {name: unit.factor * values[name] + unit.added for name, unit in self.units.items()}
        return self.expression.evaluate(own)

    def pasts(self, columns: Collection[str]) -> list[Past]:
        """History coordinates of the columns that the law reads."""
        found = (past_of(read.argument, columns) for read in self.reads.values())
        return [past for past in found if past is not None]

    def __call__(self, *quantities: Any, **values: float) -> Any:
        """The changed quantity."""
        state = dict(zip(self.arguments, quantities, strict=True))
        before, found = state[self.file.acts_on], self.expression_at(state, values)
        if self.file.form == "factor":
            return before * found
        if self.file.form == "add":
            return before + found
        return np.broadcast_to(found, np.broadcast_shapes(np.shape(before), found.shape))


def read_law(path: Path, columns: Collection[str] = ()) -> Effect:
    """The effect of a law file; ``columns``: further names of numbers that the recording has."""
    return _law(parse_toml(LawFile, read_toml(path), str(path)), path.read_text(encoding="utf-8-sig"), path, columns)


def law_of_text(text: str, path: Path, columns: Collection[str] = ()) -> Effect:
    """The effect of the text of a law file that is not written yet."""
    return _law(parse_toml(LawFile, tomllib.loads(text), str(path)), text, path, columns)


def _law(file: LawFile, text: str, path: Path, columns: Collection[str]) -> Effect:
    where = str(path)
    if file.id in catalogue():
        raise InputError("is the id of an effect of the catalogue; take another", where=f"{where}: id", value=file.id)
    if file.acts_on not in GLOSSARY:
        rule = f"no such quantity; {nearest(file.acts_on, GLOSSARY)}"
        raise InputError(rule, where=f"{where}: acts_on", value=file.acts_on)
    for name in file.parameters:
        if _read(name, columns) is not None:
            raise InputError("is a quantity too; take another name", where=f"{where}: parameters", value=name)
    names = _Names(file.parameters, columns)
    expression = parse(file.expression, names, f"{where}: expression")
    for name in file.parameters:
        if name not in expression.names:
            raise InputError("is not in the expression", where=f"{where}: parameters", value=name)
    reads = {name: found for name in expression.names if (found := _read(name, columns)) is not None}
    units = {name: _unit(p, f"{where}: parameters.{name}") for name, p in file.parameters.items()}
    law = FileLaw(file, text, path, expression, reads, units)
    return Effect(
        name=file.id,
        law=law,
        equation=_equation(law),
        source=file.source or path.name,
        stage=file.stage,
        acts_on=(file.acts_on,),
        parameters=tuple(_parameter(name, p) for name, p in file.parameters.items()),
        fingerprint={},
        separated_by=file.separated_by or _separated(law),
        valid=dict(_range(name, ends, reads, columns, where) for name, ends in file.range.items()),
    )


def as_hypothesis(law: Effect) -> Effect:
    """A law with its known numbers fixed; a law without free ones is an error."""
    known = {p.name: p.usual for p in law.parameters if isinstance(p.prior, Normal) and p.prior.sd == 0.0}
    if len(known) == len(law.parameters):
        assert isinstance(law.law, FileLaw)
        rule = "a hypothesis needs a parameter with sd or prior, over which the readings weigh it"
        raise InputError(rule, where=f"{law.law.path}: parameters", value=sorted(known))
    return law.fixing(known)


class _Names(Collection[str]):
    """Names that an expression may read: parameters, columns, and quantities with or without a unit."""

    def __init__(self, parameters: Collection[str], columns: Collection[str]) -> None:
        self.listed, self.columns = (*parameters, *columns, *GLOSSARY), columns

    def __contains__(self, name: object) -> bool:
        return name in self.listed or _read(str(name), self.columns) is not None

    def __iter__(self) -> Any:
        return iter(self.listed)

    def __len__(self) -> int:
        return len(self.listed)


def _read(name: str, columns: Collection[str]) -> Read | None:
    """How a name is read: a quantity in SI, a column or its history as recorded, or a quantity in the unit behind it.

    >>> _read("load", ()), _read("speed_rpm", ()).argument, round(_read("oil_temperature_C", ()).added, 2)
    (Read(argument='load', factor=1.0, added=0.0), 'pinion_speed', 273.15)
    """
    if name in GLOSSARY or name in columns or past_of(name, columns) is not None:
        return Read(name)
    quantity, unit = IN_OTHER_WORDS.get(without_unit(name), without_unit(name)), ENDINGS.get(ending_of(name), "")
    if quantity not in GLOSSARY or not unit or GLOSSARY[quantity].unit == "*":
        return None
    same = dimension(tidy(unit)) == GLOSSARY[quantity].dimension
    return Read(quantity, *to_si(unit)) if same else None


def _unit(parameter: LawParameter, where: str) -> Read:
    try:
        return Read("", *to_si(parameter.unit))
    except KeyError:
        rule = "no such unit; one as N, 1/GPa, mPa s or W/(m K), and - for none"
        raise InputError(rule, where=f"{where}.unit", value=parameter.unit) from None


def _parameter(name: str, p: LawParameter) -> Parameter:
    prior: Prior = p.prior.prior if p.prior is not None else Normal(p.value, p.sd or 0.0)
    return Parameter(
        name, p.unit, prior, p.meaning or f"{name} of the expression", p.null, _letter(name), nominal=p.value
    )


def _range(
    name: str, ends: Ends, reads: Mapping[str, Read], columns: Collection[str], where: str
) -> tuple[str, tuple[float, float]]:
    """Quantity of a range with its ends in SI; a column read by the expression, or by no other name, keeps its unit."""
    read = reads.get(name) or _read(name, ()) or _read(name, columns)
    if read is None:
        rule = f"no such quantity, with or without a unit; {nearest(without_unit(name), GLOSSARY)}"
        raise InputError(rule, where=f"{where}: range", value=name)
    low, high = (read.factor * end + read.added for end in ends)
    return read.argument, (low, high)


def _equation(law: FileLaw) -> str:
    """LaTeX of the law."""
    own = symbol_in_latex(GLOSSARY[law.file.acts_on].symbol, _GREEK)

    def symbol(name: str) -> str:
        read = law.reads.get(name)
        if read is None or read.argument not in GLOSSARY or (read.factor, read.added) != (1.0, 0.0):
            return _letter(name)
        return symbol_in_latex(GLOSSARY[read.argument].symbol, _GREEK)

    tree = law.expression.tree
    found = latex(tree, symbol)
    if law.file.form == "replace":
        return rf"{own} \leftarrow {found}"
    if law.file.form == "add":
        return rf"{own} \leftarrow {own} + {found}"
    bracketed = rf"\left({found}\right)" if isinstance(tree, Call) and tree.of in ("+", "-", "negative") else found
    return rf"{own} \leftarrow {own}\,{bracketed}"


def _letter(name: str) -> str:
    """LaTeX of a parameter or a column.

    >>> _letter("a"), _letter("a_1"), _letter("load_N")
    ('a', 'a_{1}', '\\\\mathrm{load\\\\ N}')
    """
    first = name.partition("_")[0]
    if len(first) == 1 or first in GREEK:
        return symbol_in_latex(name, _GREEK)
    return rf"\mathrm{{{name.replace('_', chr(92) + ' ')}}}"


def _separated(law: FileLaw) -> str:
    read = [name.replace("_", " ") for name in law.arguments if name != law.file.acts_on]
    return f"readings at other values of {' and '.join(read)}" if read else "a direct measurement of what it changes"
