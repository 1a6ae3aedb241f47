"""Published laws, each a function with decorator and docstring, and the catalogue of laws of a role."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any, ClassVar, Generic, TypeVar

from mixedlub.chain.documented import Coefficient, described, few
from mixedlub.chain.plain_text import INDENT, entry, plain_equation
from mixedlub.schema.discovery import loaded
from profiles.errors import InputError, nearest

Ranges = Mapping[str, tuple[float, float]]
"""Least and largest value of quantities, in SI."""
DISPLAY = re.compile(r"\.\. math::(.*?)(?:\n\s*\n|\Z)", re.DOTALL)
SOURCE = re.compile(r"Source: (.*?)(?:\n\s*\n|\Z)", re.DOTALL)
"""Patterns of the equation and the source in a docstring."""


@dataclass(frozen=True, repr=False, kw_only=True)
class Law:
    """A published law: function, range, and status of the constants.

    ``valid``: range of the source in SI, by quantity. ``sources``: number of independent sources of the constants
    (0: none). Equation and source default to the text of the docstring.
    """

    name: str
    law: Callable[..., Any]
    title: str = ""
    equation: str = ""
    source: str = ""
    sources: int = 0
    status: str = ""
    valid: Ranges = field(default_factory=dict)
    coefficients: tuple[Coefficient, ...] = ()
    margin: ClassVar[str] = "  "

    def __post_init__(self) -> None:
        for name, pattern in (("equation", DISPLAY), ("source", SOURCE)):
            found = pattern.search(self._text)
            if found and not getattr(self, name):
                object.__setattr__(self, name, " ".join(found[1].split()))

    @property
    def _text(self) -> str:
        return (inspect.getdoc(self.law) or "").partition(">>>")[0]

    @property
    def summary(self) -> str:
        """First line of the docstring."""
        return self._text.split("\n")[0]

    @property
    def remarks(self) -> str:
        """Text of the docstring between equation and source."""
        _, _, below = self._text.partition(".. math::")
        _, _, rest = below.partition("\n\n")
        return " ".join(rest.partition("Source: ")[0].split())

    @property
    def arguments(self) -> tuple[str, ...]:
        """Quantities taken by the function."""
        return tuple(n for n, a in inspect.signature(self.law).parameters.items() if a.kind is not a.KEYWORD_ONLY)

    @property
    def reads(self) -> tuple[str, ...]:
        """Quantities read by the law."""
        return self.arguments

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Keyword-only arguments of the law."""
        return tuple(c.name for c in self.coefficients)

    def values(self, given: Any) -> dict[str, Any]:
        """The coefficients, by default the defaults."""
        return {c.name: given.get(c.name, c.default) for c in self.coefficients}

    def check_given(self, given: Mapping[str, float], place: str, page: str) -> None:
        """Raise an error for unknown or missing coefficients; ``page``: command that shows the law."""
        known = [c.name for c in self.coefficients]
        for name in given:
            if name not in known:
                hint = nearest(name, known) if known else "it has none"
                raise InputError(f"no such coefficient of {self.name}; {hint}", where=place, value=name)
        missing = [c.name for c in self.coefficients if c.default is None and c.name not in given]
        if missing:
            rule = f"needs {few(missing)}: no source prints them; `{page}` says what they are"
            raise InputError(rule, where=place, value=dict(given) or None)

    def facts(self) -> Mapping[str, str]:
        """Lines of the page by heading; empty texts are left out."""
        return {"equation": plain_equation(self.equation), "": self.remarks, "source": self.source}

    def numbers(self) -> list[str]:
        """Lines of the page on the coefficients, with a heading."""
        width = {c.name: 2 + max(INDENT, len(c.name) + 2) for c in self.coefficients}
        lines = [entry(f"  {c.name}", described(c), width[c.name]) for c in self.coefficients]
        return ["", "coefficients", *lines] if lines else []

    def page(self) -> str:
        """Summary, equation, range, status, source and coefficients, as text of 80 columns."""
        facts = [entry(f"{self.margin}{name}", text) for name, text in self.facts().items() if text]
        return "\n".join([entry(f"{self.name}: ", self.summary, indent=2), "", *facts, *self.numbers()])

    def __repr__(self) -> str:
        return self.page()


Found = TypeVar("Found", bound=Law)
Function = TypeVar("Function", bound=Callable[..., Any])


class Catalogue(Generic[Found]):
    """Laws of one role by name, from the modules of a package and from installed plug-ins.

    Plug-ins name their modules as entry points; the group is the name of the package. ``order``: sort key of the laws
    before the name.
    """

    def __init__(
        self,
        package: str,
        role: str,
        quantities: Collection[str],
        order: Callable[[Found], Any] = lambda law: 0,
    ) -> None:
        self.package, self.role, self.quantities, self._order = package, role, quantities, order
        self._registered: dict[str, Found] = {}

    def add(self, law: Found) -> None:
        """Register a law; raise an error if signature, docstring and declaration disagree."""
        where = f"{self.role} {law.name!r}"
        known = self._registered.get(law.name)
        if known is not None and known.law.__module__ != law.law.__module__:
            raise TypeError(f"{where} is already defined in {known.law.__module__}")
        for name in (*law.arguments, *law.valid):
            if name not in self.quantities:
                raise TypeError(f"{where}: {name!r} is no quantity; {nearest(name, self.quantities)}")
        keywords = {n for n, a in inspect.signature(law.law).parameters.items() if a.kind is a.KEYWORD_ONLY}
        if keywords != set(law.parameter_names):
            raise TypeError(f"{where}: keyword-only arguments {sorted(keywords)} must be its declared numbers")
        if not law.source:
            raise TypeError(f"{where}: the docstring of its law names no 'Source: '")
        self._registered[law.name] = law
        self.__dict__.pop("all", None)

    def declares(self, make: Callable[[Any], Found]) -> Callable[[Function], Function]:
        """Decorator that registers the law which ``make`` creates from the function below."""

        def register(law: Function) -> Function:
            self.add(make(law))
            return law

        return register

    @cached_property
    def all(self) -> Mapping[str, Found]:
        """The laws by name."""
        loaded(self.package, self.package)
        ordered = sorted(self._registered.values(), key=lambda law: (self._order(law), law.name))
        return MappingProxyType({law.name: law for law in ordered})

    def find(self, name: str, where: str) -> Found:
        """Return a law by name; the error for an unknown name gives the place ``where`` and the nearest known name."""
        if not isinstance(name, str) or name not in self.all:
            raise InputError(f"no such {self.role}; {nearest(name, self.all)}", where=where, value=name)
        return self.all[name]
