"""What instrument files say by themselves, and the questions that remain."""

from __future__ import annotations

import re
import shlex
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mixedlub.kinds import kind as kind_of
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.section import table
from mixedlub.schema.system_file import KINDS, System
from mixedlub.schema.toml_file import toml_value
from profiles.errors import InputError, nearest

Answers = Mapping[str, Any]
"""Answers by dotted key: keys of system.toml, or ``import.`` and what the importer itself asks."""


PART = re.compile(r'"[^"]*"|[^.]+')
"""A part of a dotted key; a name with a point in it stands in quotes."""


@dataclass(frozen=True)
class Question:
    """Something no file says: the key that answers it, the words, an example that is valid TOML.

    ``among`` are the answers there are, ``of`` the words that introduce them. Where the example is no likely answer,
    a ``blank`` stands for it in lists that may be pasted.
    """

    key: str
    text: str
    example: str
    needed: bool = True
    among: tuple[str, ...] = ()
    of: str = "one of"
    blank: str = ""

    @property
    def choices(self) -> str:
        """The answers there are, in words."""
        return f"{self.of} {', '.join(self.among)}" if self.among else ""


class Unanswered(InputError):
    """Answers that are missing: what to ask of whoever can be asked, one question a line."""

    def __init__(self, questions: Sequence[Question]) -> None:
        self.lines = tuple(listed(questions))
        count = "1 answer is" if len(questions) == 1 else f"{len(questions)} answers are"
        self.summary = f"{count} missing; give each by --set KEY=VALUE, or all in a TOML file by --answers"
        super().__init__(self.summary + ":\n" + "\n".join(self.lines), where="import")


def listed(questions: Sequence[Question]) -> Iterator[str]:
    """A line a question, with the setting that answers it; choices are not said twice.

    >>> print(*listed([Question("kind", "Kind of recording", '"film"', among=("film", "disc"))]), sep="\\n")
      --set 'kind="film"'  (Kind of recording: one of film, disc)
    """
    said: set[str] = set()
    for q in questions:
        words = q.text if not q.choices or q.choices in said else f"{q.text}: {q.choices}"
        said.add(q.choices)
        words += f", for example {q.example}" if q.blank and not q.choices else ""
        yield f"  --set {shlex.quote(f'{q.key}={q.blank or q.example}')}  ({words})"


@dataclass(frozen=True)
class Draft:
    """A case in the making: columns in the units of the contract, facts for system.toml, open questions."""

    kind: str | None
    quantity: str | None
    columns: Mapping[str, np.ndarray]
    system: Mapping[str, Any] = field(default_factory=dict)
    questions: tuple[Question, ...] = ()
    notes: tuple[Finding, ...] = ()
    runs: np.ndarray | None = None
    """Numbers of the readings, where the file has them and each stands once."""


def _question(section: str, key: str, needed: bool) -> Question:
    described = table(System, section)[key]
    values = ", ".join(f"{value}: {meaning}" for value, meaning in described.values.items())
    words = f"{described.words} ({values})" if values else described.words
    return Question(f"{section}.{key}", words[:1].upper() + words[1:], toml_value(described.example), needed)


CONTACT = (
    replace(_question("contact", "radius_mm", True), blank="[RADIUS, RADIUS]"),
    replace(_question("contact", "youngs_modulus_GPa", True), blank="[MODULUS, MODULUS]"),
    replace(_question("contact", "poisson_ratio", True), blank="[RATIO, RATIO]"),
)
FORMS = tuple(table(System, "contact")["geometry"].values)
FORM = replace(_question("contact", "geometry", True), among=FORMS, blank=f'"{" OR ".join(FORMS).upper()}"')
WIDTH = replace(_question("contact", "width_mm", True), blank="WIDTH")
OIL = tuple(
    _question("lubricant", key, False)
    for key in ("name", "temperature_C", "kinematic_viscosity_mm2_s", "pressure_viscosity_per_GPa")
)
EVERY = Question("import.every", "Keep one reading of how many", "10", needed=False)
NOISE = tuple(_question("recording.noise", key, False) for key in ("relative", "absolute"))


def questions_of(kind: str) -> tuple[Question, ...]:
    """What every case of a kind leaves to ask."""
    contact = CONTACT if "contact" in kind_of(kind).sections else ()
    oil = OIL if kind in ("film", "disc", "gear_pair", "mesh_friction") else ()
    many = (EVERY,) if kind in ("friction_history", "viscosity") else ()
    return (*contact, *oil, *many, *NOISE)


def contact_form(kind: str, answers: Answers) -> tuple[Question, ...]:
    """Whether the contact is a line or a point, and how wide, where a kind has one and nothing says it."""
    told = "contact.width_mm" in answers or answers.get("contact.geometry") == "point"
    if told or "contact" not in kind_of(kind).sections:
        return ()
    return (WIDTH,) if "contact.geometry" in answers else (FORM, WIDTH)


def read_note(text: str, name: str = "") -> Finding:
    """What an importer made of a file."""
    return finding("file_read", text, name)


def open_questions(draft: Draft, answers: Answers) -> tuple[Question, ...]:
    """The needed questions that are not answered yet."""
    return tuple(q for q in draft.questions if q.needed and q.key not in answers)


def refuse_unknown(answers: Answers, known: Sequence[str]) -> None:
    """An error about the first answer for the importer that it has no use for.

    >>> refuse_unknown({"import.evry": 10, "kind": "film"}, [])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: import.evry: key is not known for this file; nearest known: 'import.every'
    """
    keys = (EVERY.key, *known)
    for key in answers:
        if PART.findall(key)[:1] == ["import"] and key not in keys:
            raise InputError(f"key is not known for this file; {nearest(key, keys)}", where=key)


def kind_told(answers: Answers, made: Collection[str]) -> str | None:
    """The kind that is told; an error where the file's reader makes no such case.

    >>> kind_told({"kind": "disc"}, ["viscosity"])
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: kind: 'disc': is no kind that files of this rig make; they make viscosity
    """
    kind = answers.get("kind")
    if kind is None or kind in made:
        return kind
    known = kind in KINDS
    rule = f"is no kind that files of this rig make; they make {', '.join(made)}"
    raise InputError(rule if known else f"no such kind; {nearest(str(kind), KINDS)}", where="kind", value=kind)


def nested(answers: Answers) -> dict[str, Any]:
    """Dotted keys as tables; what belongs to the importer is left out.

    >>> nested({"contact.radius_mm": [9.5, 20.0], "import.temperature": "pot", "kind": "film"})
    {'contact': {'radius_mm': [9.5, 20.0]}, 'kind': 'film'}
    >>> nested({'surfaces."Ra 0.4".m2': 0.003})
    {'surfaces': {'Ra 0.4': {'m2': 0.003}}}
    """
    tree: dict[str, Any] = {}
    for key, value in answers.items():
        *above, last = (part.strip('"') for part in PART.findall(key))
        if above[:1] == ["import"]:
            continue
        place = tree
        for part in above:
            place = place.setdefault(part, {})
        place[last] = value
    return tree


def flat(tree: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Tables as dotted keys; those of the first level may be dotted already.

    >>> flat({"contact": {"radius_mm": [9.5, 20.0]}, "kind": "film"})
    {'contact.radius_mm': [9.5, 20.0], 'kind': 'film'}
    """
    found: dict[str, Any] = {}
    for key, value in tree.items():
        part = f'"{key}"' if above and "." in key else key
        name = f"{above}.{part}" if above else part
        found.update(flat(value, name) if isinstance(value, Mapping) and value else {name: value})
    return found
