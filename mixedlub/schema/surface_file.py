"""Format of a surface in `system.toml`: moments, or traces or a map with these moments."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mixedlub.schema.section import Flag, Number, Section, key

Files = Annotated[tuple[str, ...], Field(min_length=1)]

STEEL = {"conductivity": 46.0, "density": 7800.0, "heat_capacity": 470.0}
"""Judgement. Thermal conductivity (W/(m K)), density (kg/m^3) and specific heat (J/(kg K)) of gear steels;
density in handbooks: 7,750 to 7,850."""
ONE_NUMBER = ("Ra", "Rq", "Rz")
"""Definition. Numbers from which alone a surface may be assumed."""
SURFACE_FILES = ("profile", "traces", "traces_along", "map")
"""Keys of a surface with file names."""


class Coating(Section):
    name: str = key("name of the coating, for the report", "coating", example="DLC")
    thickness_um: Number = key("thickness of the coating", example=3.0)
    thermal_conductivity_W_mK: Number = key("thermal conductivity of the coating", example=2.0)


class SurfaceSection(Section):
    m0_um2: Number | None = key("variance of the heights; all three moments, or a profile", None, example=0.137)
    m2: Number | None = key("variance of the slopes of the profile", None, example=0.0031)
    m4_per_um2: Number | None = key("variance of the curvatures of the profile", None, example=0.0021)
    Ra_um: Number | None = key(
        "instead of the moments: mean height of the profile alone; slopes and curvatures are then assumed, with a band",
        None,
        example=0.4,
        alternative=True,
    )
    Rq_um: Number | None = key("the same from the rms height alone", None, example=0.5, alternative=True)
    Rz_um: Number | None = key(
        "the same from the mean peak-to-valley height alone", None, example=2.5, alternative=True
    )
    profile: str | None = key(
        "instead of the moments: file of a trace, relative to this file, or shipped:NAME",
        None,
        example="profiles/ground.csv",
        alternative=True,
    )
    traces: Files | None = key(
        "instead of one trace: files of several, all across the lay; their moments are averaged",
        None,
        example=["profiles/ground_1.csv", "profiles/ground_2.csv", "profiles/ground_3.csv"],
        alternative=True,
    )
    traces_along: Files | None = key(
        "files of traces along the lay, beside those across it", None, example=["profiles/along.csv"], alternative=True
    )
    map: str | None = key(
        "instead of traces: file of an areal height map: x3p, SDF, text, and more with mixedlub[formats]",
        None,
        example="profiles/ground.x3p",
        alternative=True,
    )
    holes: Literal["mask", "fill"] = key(
        "points of a map without a height",
        "mask",
        example="fill",
        alternative=True,
        values={
            "mask": "left out of the moments; a map with more than a fifth of them is refused",
            "fill": "closed by a smooth surface from their rims, up to half of the map",
        },
    )
    m2_along: Number | None = key(
        "variance of the slopes along the lay; m2 is then across it", None, example=0.0002, alternative=True
    )
    m4_along_per_um2: Number | None = key(
        "variance of the curvatures along the lay; m4_per_um2 is then across it", None, example=1e-5, alternative=True
    )
    lay: Literal["transverse", "longitudinal", "isotropic"] | None = key(
        "direction of the lay, given for both surfaces of a contact or for neither; left out: transverse where the "
        "surface is known in two directions, else unknown",
        None,
        example="isotropic",
        alternative=True,
        values={
            "transverse": "ridges across the direction of motion, as flanks ground along the face",
            "longitudinal": "ridges along the direction of motion",
            "isotropic": "no lay: the moments hold in every direction",
        },
    )
    unit: str | None = key(
        "unit of a trace or map of plain numbers, as um or 'mm, um' (place, height); left out: as its file says",
        None,
        example="mm, um",
        alternative=True,
    )
    spacing: str | None = key(
        "step of a trace or map, as '0.5 um'; left out: as its file says", None, example="0.5 um", alternative=True
    )
    cutoff_mm: Number | None = key("long cut-off of a trace; left out: its own, or by ISO 4288", None, example=0.8)
    short_cutoff_um: Number | None = key(
        "short cut-off of a trace; left out: its own, or by ISO 3274", None, example=2.5
    )
    form: str | None = key(
        "form taken off a trace: line (left out), none, mean, circle, polynomial-N, involute-MM", None, example="line"
    )
    edges: Flag = key("true: chamfers and falling ends are cut off", True, example=False)
    outliers: Number | None = key("a trace is masked beyond so many robust standard deviations", None, example=5.0)
    coating: Coating | None = key(
        "only where there is one", None, example={"name": "DLC", "thickness_um": 3.0, "thermal_conductivity_W_mK": 2.0}
    )
    thermal_conductivity_W_mK: Number = key("thermal conductivity of the body", STEEL["conductivity"])
    density_kg_m3: Number = key("density of the body", STEEL["density"])
    specific_heat_J_kgK: Number = key("specific heat of the body", STEEL["heat_capacity"])

    @property
    def files(self) -> tuple[str, ...]:
        """Traces across the lay, or in the only known direction."""
        return self.traces or (() if self.profile is None else (self.profile,))

    @property
    def one_number(self) -> tuple[str, float] | None:
        """Name and value (m) of the only known number of the surface."""
        known = ((name, getattr(self, f"{name}_um")) for name in ONE_NUMBER)
        return next(((name, value * 1e-6) for name, value in known if value is not None), None)

    @property
    def is_measured(self) -> bool:
        """Whether the moments come from traces or a map."""
        return bool(self.files) or self.map is not None

    @property
    def has_two_directions(self) -> bool:
        """Whether the surface is known across and along its lay."""
        return self.map is not None or self.traces_along is not None or self.m2_along is not None

    @model_validator(mode="after")
    def _moments_or_profile(self) -> SurfaceSection:
        moments = (self.m0_um2, self.m2, self.m4_per_um2)
        measured = [name for name in ("profile", "traces", "map") if getattr(self, name) is not None]
        alone = [f"{name}_um" for name in ONE_NUMBER if getattr(self, f"{name}_um") is not None]
        others = [*measured, *(["moments"] if any(m is not None for m in (*moments, self.m2_along)) else [])]
        if alone and (others or len(alone) > 1):
            raise ValueError(f"has both {alone[0]} and {(others or alone[1:])[0]}; give one of them")
        if not measured and not alone and None in moments:
            raise ValueError("needs m0_um2, m2 and m4_per_um2, or a profile, or one of Ra_um, Rq_um and Rz_um")
        if measured and any(m is not None for m in (*moments, self.m2_along, self.m4_along_per_um2)):
            raise ValueError(f"has both moments and a {measured[0].removesuffix('s')}; give one of them")
        if len(measured) > 1:
            raise ValueError(f"has both {measured[0]} and {measured[1]}; give one of them")
        if not self.files and self.traces_along is not None:
            raise ValueError("traces along the lay (traces_along) belong to a profile or traces, which are not given")
        if not self.is_measured and (self.unit or self.spacing) is not None:
            raise ValueError("unit and spacing belong to a profile, traces or a map, which are not given")
        if self.map is None and "holes" in self.model_fields_set:
            raise ValueError("holes belongs to a map, which is not given")
        if self.map is not None and self.model_fields_set & {"edges", "outliers"}:
            raise ValueError("edges and outliers belong to a profile or traces; a map takes neither")
        return self

    @model_validator(mode="after")
    def _lay_of_its_directions(self) -> SurfaceSection:
        if (self.m2_along is None) != (self.m4_along_per_um2 is None):
            raise ValueError("moments along the lay are both m2_along and m4_along_per_um2")
        if self.lay == "isotropic" and (self.traces_along or self.m2_along) is not None:
            raise ValueError('lay = "isotropic" has one direction; leave out what is along the lay')
        if self.lay not in (None, "isotropic") and not self.has_two_directions:
            raise ValueError(f'lay = "{self.lay}" needs traces_along, or m2_along and m4_along_per_um2, or a map')
        return self
