"""Format of a file with one law of the user."""

from __future__ import annotations

import re
from keyword import iskeyword
from typing import Literal

from pydantic import field_validator, model_validator

from mixedlub.chain.effect import STAGES
from mixedlub.chain.priors import LogNormal, LogUniform, Normal, Prior, Uniform
from mixedlub.expressions import FUNCTIONS
from mixedlub.schema.section import Float, Number, Section, key, one_of

Pair = tuple[Number, Number]
Ends = tuple[Float, Float]
RESERVED = ("none", "unknown", "law")
"""Words of the answer and of the section ``[effects]``, which are no ids and no parameters."""
FORMS = {
    "factor": "the quantity is multiplied by the expression",
    "add": "the expression is added to the quantity, in SI",
    "replace": "the expression, in SI, takes the place of the quantity",
}


class LawPrior(Section):
    normal: Pair | None = key("mean and standard deviation", None, example=[0.0, 0.3])
    lognormal: Pair | None = key("median, and standard deviation of the logarithm", None, alternative=True)
    uniform: Pair | None = key("lowest and highest value", None, alternative=True)
    loguniform: Pair | None = key("lowest and highest value, each order of magnitude alike", None, alternative=True)

    @model_validator(mode="after")
    def _is_one(self) -> LawPrior:
        given = [(name, pair) for name, pair in self if pair is not None]
        if len(given) != 1:
            raise ValueError(f"needs one of {', '.join(type(self).model_fields)}, as normal = [0.0, 0.3]")
        name, (first, second) = given[0]
        if name in ("normal", "lognormal") and second <= 0.0:
            raise ValueError(f"{name} needs a standard deviation above 0, not {second:g}")
        if name in ("uniform", "loguniform") and first >= second:
            raise ValueError(f"{name} needs the lower end first")
        if name.startswith("log") and first <= 0.0:
            raise ValueError(f"{name} needs numbers above 0")
        return self

    @property
    def prior(self) -> Prior:
        """The prior distribution."""
        if self.normal is not None:
            return Normal(*self.normal)
        if self.lognormal is not None:
            return LogNormal(*self.lognormal)
        return Uniform(*self.uniform) if self.uniform is not None else LogUniform(*(self.loguniform or (1.0, 2.0)))


class LawParameter(Section):
    unit: str = key("unit of the numbers of this table; the expression takes the parameter in SI", "-", example="N")
    value: Number = key("value in a study, in [effects] and at the start of a fit", unit="as stated", example=0.1)
    sd: Number | None = key(
        "standard deviation about the value; this or prior; with neither the value is taken as known",
        None,
        unit="as stated",
        example=0.3,
    )
    prior: LawPrior | None = key(
        "instead of sd: what is known before any reading, as { lognormal = [0.05, 0.7] }", None, alternative=True
    )
    null: Number | None = key("value at which the law changes nothing", None, unit="as stated", example=0.0)
    meaning: str = key("what the parameter is, for pages", "", example="exponent of the load")

    @model_validator(mode="after")
    def _one_of_both(self) -> LawParameter:
        if self.sd is not None and self.prior is not None:
            raise ValueError("sd and prior say the same twice; leave one of them out")
        if self.sd is not None and self.sd <= 0.0:
            raise ValueError("sd must be above 0; left out, the value is taken as known")
        return self


class LawFile(Section):
    """One law of the user."""

    id: str = key("name of the law", example="film_of_load")
    description: str = key("one sentence for pages", "", example="The film falls with load more than the base has it.")
    stage: str = key(f"part of the model: {', '.join(STAGES)}", example="film")
    acts_on: str = key("quantity of the glossary that the law changes, or reading", example="film_thickness")
    form: Literal["factor", "add", "replace"] = key("how it changes the quantity", example="factor", values=FORMS)
    expression: str = key(
        f"arithmetic, powers (^ or **), {', '.join(FUNCTIONS)} of quantities, columns and parameters",
        example="(load/420 N)^a",
    )
    parameters: dict[str, LawParameter] = key("one table a parameter, by the name in the expression")
    source: str = key("where the law is from", "", example="own film measurements of May")
    range: dict[str, Ends] = key(
        "QUANTITY_UNIT = [LOW, HIGH]: where the law holds; outside, the result says so",
        {},
        example={"load_N": [200.0, 1500.0]},
    )
    separated_by: str = key("test that shows the law and nothing else", "")

    @field_validator("id")
    @classmethod
    def _is_word(cls, name: str) -> str:
        if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or name in RESERVED:
            raise ValueError("must be a word of small letters, digits and underscores, other than none and unknown")
        return name

    @field_validator("stage")
    @classmethod
    def _is_known(cls, name: str) -> str:
        return one_of(name, STAGES)

    @field_validator("parameters")
    @classmethod
    def _are_names(cls, parameters: dict[str, LawParameter]) -> dict[str, LawParameter]:
        if not parameters:
            raise ValueError("needs at least one table [parameters.NAME] with a value: a law is fitted by its numbers")
        for name in parameters:
            if not name.isidentifier() or iskeyword(name) or name in (*FUNCTIONS, *RESERVED) or name.endswith("_sd"):
                raise ValueError(f"{name!r} is no name of a parameter: a word that is no function and ends in no _sd")
        return parameters
