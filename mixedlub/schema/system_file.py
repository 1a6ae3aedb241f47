"""What `system.toml` may say: one class a section, validated once, every error with its place."""

from __future__ import annotations

import re
import tomllib
from itertools import chain
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)

from mixedlub.schema import messages, ranges
from profiles.errors import InputError, nearest

T = TypeVar("T", bound=BaseModel)


def _number(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        raise ValueError("must be a number")
    return value


def _whole(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        raise ValueError("must be a whole number")
    return value


Float = Annotated[float, BeforeValidator(_number)]
Number = Annotated[Float, Field(allow_inf_nan=False)]
NotNegative = Annotated[Float, Field(ge=0, allow_inf_nan=False)]
Whole = Annotated[int, BeforeValidator(_whole)]
KINDS = ("gear_pair", "mesh_friction", "disc", "film", "friction_history", "friction_map", "viscosity")


class Section(BaseModel):
    """A table of the file: unknown keys are errors, values never change, and lie within the bounds of `ranges.toml`.

    ``place`` is where the bounds of its keys stand there.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    place: ClassVar[str] = ""

    @field_validator("*")
    @classmethod
    def _possible(cls, value: Any, info: ValidationInfo) -> Any:
        broken = ranges.broken(f"{cls.place}.{info.field_name}".lstrip("."), value)
        if broken:
            raise ValueError(broken)
        return value


class LoadSharing(Section):
    place = "gears.load_sharing"

    table: str | None = None
    model: Literal["ldp", "rigid"] | None = None
    tip_relief_um: tuple[Number, Number] = (0.0, 0.0)
    relief_length_mm: tuple[Number, Number] = (0.0, 0.0)
    lead_crown_um: Number = 0.0
    misalignment_um: Number = 0.0

    @model_validator(mode="after")
    def _table_or_model(self) -> LoadSharing:
        if (self.table is None) == (self.model is None):
            raise ValueError('needs either table = "FILE", or model = "ldp" or "rigid"; not both')
        return self


class Gears(Section):
    place = "gears"

    teeth: tuple[Whole, Whole]
    normal_module_mm: Number
    pressure_angle_deg: Number = 20.0
    helix_angle_deg: Number = 0.0
    profile_shift: tuple[Number, Number] = (0.0, 0.0)
    tip_diameter_mm: tuple[Number, Number] | None = None
    centre_distance_mm: Number | None = None
    face_width_mm: Number
    youngs_modulus_GPa: tuple[Number, Number] = (206.0, 206.0)
    poisson_ratio: tuple[Number, Number] = (0.3, 0.3)
    load_sharing: LoadSharing = LoadSharing(model="rigid")


class Contact(Section):
    place = "contact"

    geometry: Literal["line", "point"] = "line"
    radius_mm: tuple[Float, Float]
    width_mm: Number | None = None
    youngs_modulus_GPa: tuple[Number, Number] = (206.0, 206.0)
    poisson_ratio: tuple[Number, Number] = (0.3, 0.3)

    @model_validator(mode="after")
    def _line_has_width(self) -> Contact:
        if self.geometry == "line" and self.width_mm is None:
            raise ValueError("a line contact needs width_mm")
        return self


class Lubricant(Section):
    place = "lubricant"

    name: str = "unnamed oil"
    base: Literal["mineral", "pao", "ester", "pag"] | None = None
    temperature_C: tuple[Number, Number] | None = None
    kinematic_viscosity_mm2_s: tuple[Number, Number] | None = None
    pressure_viscosity_per_GPa: tuple[Number, Number] | None = None
    density_15C_kg_m3: Number | None = None
    density_change_per_K: Number | None = None
    eyring_stress_MPa: Number | None = None
    thermal_conductivity_W_mK: Number | None = None
    specific_heat_J_kgK: Number | None = None


class Coating(Section):
    place = "surfaces.coating"

    name: str = "coating"
    thickness_um: Number
    thermal_conductivity_W_mK: Number


class SurfaceSection(Section):
    place = "surfaces"

    m0_um2: Number | None = None
    m2: Number | None = None
    m4_per_um2: Number | None = None
    profile: str | None = None
    cutoff_mm: Number | None = None
    short_cutoff_um: Number | None = None
    form: str | None = None
    edges: Annotated[bool, Field(strict=True)] = True
    outliers: Number | None = None
    coating: Coating | None = None
    thermal_conductivity_W_mK: Number = 46.0
    density_kg_m3: Number = 7800.0
    specific_heat_J_kgK: Number = 470.0

    @model_validator(mode="after")
    def _moments_or_profile(self) -> SurfaceSection:
        moments = (self.m0_um2, self.m2, self.m4_per_um2)
        if self.profile is None and None in moments:
            raise ValueError("needs m0_um2, m2 and m4_per_um2, or a profile")
        if self.profile is not None and any(m is not None for m in moments):
            raise ValueError("has both moments and a profile; give one of them")
        return self


class Uncertainty(Section):
    place = "uncertainty"

    boundary_friction: Number = 0.0
    viscosity: Number = 0.0
    pressure_viscosity: Number = 0.0
    eyring_stress: Number = 0.0
    roughness: Number = 0.0


class Noise(Section):
    place = "recording.noise"

    relative: Number = 0.0
    absolute: NotNegative = 0.0
    setup_relative: Number = 0.0
    setup_absolute: NotNegative = 0.0

    @property
    def of_single(self) -> bool:
        """Whether it says how much single readings scatter."""
        return self.relative > 0 or self.absolute > 0

    @property
    def of_setups(self) -> bool:
        """Whether it says how much set-ups are off as a whole."""
        return self.setup_relative > 0 or self.setup_absolute > 0


class Recording(Section):
    place = "recording"

    quantity: Literal[
        "power_loss_W", "friction_coefficient", "film_thickness_nm", "friction_torque_Nm", "viscosity_mPa_s"
    ]
    includes: str = ""
    ambient_temperature_C: Number = 25.0
    check: str | None = None
    noise: Noise | None = None


class System(Section):
    """Everything the engineer knows about the rig."""

    schema_: Literal["mixedlub-case/1"] = Field(alias="schema")
    kind: Literal["gear_pair", "mesh_friction", "disc", "film", "friction_history", "friction_map", "viscosity"]
    boundary_friction: Number = 0.1
    description: str = ""
    gears: Gears | None = None
    contact: Contact | None = None
    lubricant: Lubricant | None = None
    surfaces: dict[str, SurfaceSection] = {}
    uncertainty: Uncertainty = Uncertainty()
    recording: Recording


def read_toml(path: Path) -> dict[str, Any]:
    """The file's content, or an error saying why it is not TOML."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise InputError("no such file", where=str(path)) from None
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(f"is not readable as TOML ({error})", where=str(path)) from None


def parse(model: type[T], data: dict[str, Any], where: str) -> T:
    """The validated section; the first error becomes a message that names place, value and rule."""
    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise _refused(model, error.errors(), where) from None


def _refused(model: type[BaseModel], errors: list[Any], where: str) -> InputError:
    """What to say of the errors: another kind of file first, then unknown keys, which explain missing ones."""
    other = (e for e in errors if e["loc"] == ("schema",) and e["type"] == "literal_error")
    unknown = (e for e in errors if e["type"] == "extra_forbidden")
    first = next(chain(other, unknown), errors[0])
    *table, last = first["loc"] or ("",)
    if first["type"] == "extra_forbidden":
        hint = nearest(str(last), _known_keys(model, tuple(table)))
        return InputError(f"key is not known; {hint}", where=f"{where}: {messages.place(first['loc'])}")
    if first["type"] == "missing" and isinstance(last, int):
        needed = 1 + max(e["loc"][-1] for e in errors if e["loc"][:-1] == tuple(table))
        said = f"needs {messages.counted(needed)}, not {last}"
        return InputError(said, where=f"{where}: {messages.place(table)}", value=first["input"])
    shown = None if first["type"] == "missing" or isinstance(first["input"], dict) else first["input"]
    place = f"{where}: {messages.place(first['loc'])}" if first["loc"] else where
    return InputError(messages.rule(first), where=place, value=shown)


def in_file(error: InputError, file: str) -> InputError:
    """An error about a key of a file, with the file and the table of the key; one that names its place stays.

    >>> print(in_file(InputError("teeth interfere", where="teeth", value=[5, 60]), "system.toml"))
    system.toml: gears.teeth: [5, 60]: teeth interfere
    """
    key = re.split(r"[.,\[]", error.where)[0]
    tables: dict[str, type[Section]] = {"": System, "gears.": Gears, "gears.load_sharing.": LoadSharing}
    for table, section in tables.items():
        if key in section.model_fields and (table == "" or key == error.where):
            return InputError(error.rule, where=f"{file}: {table}{error.where}", value=error.value)
    return error


def _known_keys(model: type[BaseModel], place: tuple[Any, ...]) -> list[str]:
    """Keys allowed at a place of the nested tables."""
    from typing import get_args

    current: Any = model
    for part in place:
        fields = getattr(current, "model_fields", {})
        annotation = fields[part].annotation if part in fields else current
        options = [a for a in (annotation, *_flatten(get_args(annotation))) if _is_model(a)]
        named = [a for a in options if a.__name__ == part]
        if named or options:
            current = (named or options)[0]
    fields = getattr(current, "model_fields", {})
    return [f.alias or name for name, f in fields.items()]


def _flatten(args: tuple[Any, ...]) -> list[Any]:
    from typing import get_args

    return [inner for a in args for inner in (a, *_flatten(get_args(a)))]


def _is_model(a: Any) -> bool:
    return isinstance(a, type) and issubclass(a, BaseModel)
