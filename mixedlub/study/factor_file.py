"""Content of a file of factors: the study, its factors with their levels, and the design."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, field_validator, model_validator

from mixedlub.schema.section import Section, Whole, key, one_of
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.study.columns import FIRST, FURTHER
from mixedlub.study.schema import Names, Numbers, each_once

OVER = ("torque_Nm", "speed_rpm", "oil_temperature_C")
"""Conditions of the study that are factors of a full factorial."""
MOST_RUNS = 100_000
RESPONSES = tuple(c.name for c in (*FIRST, *FURTHER))
Seeds = Annotated[tuple[Whole, ...], Field(min_length=1)]


def _known_response(name: str) -> str:
    one_of(name, RESPONSES)
    return name


class Factors(Section):
    """Factors with their levels; a random design varies a number uniformly between the smallest and the largest."""

    gears: Names | None = key(
        "gears, by name or file with a section [gears]; each takes the place of [gears], whose load_sharing stays",
        None,
        example=["high_speed_a", "high_speed_b"],
        alternative=True,
    )
    normal_module_mm: Numbers | None = key(
        "normal modules; tip diameters and centre distance go with them", None, example=[3.0, 4.5], alternative=True
    )
    oil: Names | None = key(
        "oils, by name or file; each takes the place of [lubricant]", None, example=["m100", "pao_vg100"]
    )
    load_sharing: Names | None = key(
        "models of load sharing, by name", None, example=["rigid", "ldp"], alternative=True
    )
    boundary_friction: Numbers | None = key("friction of touching asperities", None, example=[0.08, 0.12])
    face_width_mm: Numbers | None = key("face widths", None, example={"from": 10, "to": 20, "count": 3})
    tip_relief_um: Numbers | None = key(
        "tip relief of both wheels; load_sharing of the study has its length", None, example=[10, 30], alternative=True
    )
    pressure_angle_deg: Numbers | None = key("normal pressure angles", None, example=[20, 25], alternative=True)
    helix_angle_deg: Numbers | None = key("helix angles", None, example=[0, 20], alternative=True)
    centre_distance_mm: Numbers | None = key(
        "working centre distances of the same wheels", None, example=[91.0, 91.3], alternative=True
    )
    lead_crown_um: Numbers | None = key(
        "crowns over the face; elastic load sharing", None, example=[0, 10], alternative=True
    )
    misalignment_um: Numbers | None = key(
        "misalignments over the face width; elastic load sharing", None, example=[0, 20], alternative=True
    )
    profile_slope_deviation_um: Numbers | None = key(
        "profile slope deviations of the pinion; elastic load sharing", None, example=[-8, 8], alternative=True
    )
    friction: Names | None = key(
        "friction laws, by name, of which none asks for coefficients",
        None,
        example=["tallian_mixture", "xu_kahraman"],
        alternative=True,
    )
    cutoff_mm: Numbers | None = key("long cut-off of all traces", None, example=[0.25, 0.8], alternative=True)
    short_cutoff_um: Numbers | None = key("short cut-off of all traces", None, example=[2.5, 8.0], alternative=True)
    replicate: Seeds | None = key(
        "seeds: for each, the sampling lengths of every trace are drawn anew with replacement",
        None,
        example=[1, 2, 3],
        alternative=True,
    )
    torque_Nm: Numbers | None = key("torque; in a random design only", None, example=[50, 150], alternative=True)
    speed_rpm: Numbers | None = key("speed; in a random design only", None, example=[500, 3000], alternative=True)
    oil_temperature_C: Numbers | None = key(
        "oil temperature; in a random design only", None, example=[40, 90], alternative=True
    )

    @field_validator("*")
    @classmethod
    def _each_level_once(cls, levels: Any) -> Any:
        return levels if levels is None else each_once(levels)

    @property
    def given(self) -> dict[str, tuple[Any, ...]]:
        """Levels of every varied factor."""
        return {name: levels for name in type(self).model_fields if (levels := getattr(self, name)) is not None}

    @model_validator(mode="after")
    def _something_varies(self) -> Factors:
        single = [name for name, levels in self.given.items() if len(levels) < 2]
        if single or not self.given:
            rule = f"{single[0]} has one level; a factor needs two or more" if single else "names no factor to vary"
            raise ValueError(rule)
        return self


class Design(Section):
    """Combinations of levels to run."""

    kind: Literal["full_factorial", "latin_hypercube", "sobol"] = key(
        "how the runs are chosen",
        "full_factorial",
        values={
            "full_factorial": "every combination of the levels",
            "latin_hypercube": "random runs, even in every factor",
            "sobol": "runs along Sobol' sequences, even in all factors together",
        },
    )
    runs: Annotated[Whole, Field(ge=2, le=MOST_RUNS)] | None = key(
        "base runs of a random design, a power of 2; computed are that many times the number of factors plus 2",
        None,
        example=64,
        alternative=True,
    )
    seed: Annotated[Whole, Field(ge=0)] = key("seed of a random design", 1)
    response: Annotated[str, AfterValidator(_known_response)] = key(
        "column of the table that the effects are of; a random design takes its mean over pairings and conditions",
        "power_loss_W",
    )

    @property
    def random(self) -> bool:
        """Whether the runs are random."""
        return self.kind != "full_factorial"

    @model_validator(mode="after")
    def _runs_where_drawn(self) -> Design:
        if self.random and self.runs is None:
            raise ValueError(f'kind = "{self.kind}" needs runs, a power of 2')
        if not self.random and self.runs is not None:
            raise ValueError("runs acts only with a random design; leave it out")
        if self.runs is not None and self.runs & (self.runs - 1):
            raise ValueError(f"runs = {self.runs} must be a power of 2")
        return self


class FactorFile(Section):
    """A file of factors."""

    schema_: Literal["mixedlub-factors/1"] = key("format of the file", example="mixedlub-factors/1", alias="schema")
    title: str = key("title of the figures", "Factors", example="What decides the loss")
    study: str = key("file of the study that is varied, relative to this file", example="study.toml")
    factors: Factors = key("what is varied, each a list of levels, or { from = LOW, to = HIGH, count = N }")
    design: Design = key("which combinations are run", Design())

    @model_validator(mode="after")
    def _conditions_where_drawn(self) -> FactorFile:
        for name in self.factors.given:
            if name in OVER and not self.design.random:
                raise ValueError(f"factors.{name}: a full factorial has the levels of [conditions] of the study")
        return self


def read_factor_file(path: Path) -> FactorFile:
    """Read a file of factors."""
    return parse(FactorFile, read_toml(path), str(path))
