"""Table of the options and effects that choose a law of the same step, and so refuse each other."""

from __future__ import annotations

from collections.abc import Iterable

from markdown_tables import table


def pairs() -> str:
    """Each step with its options and effects; any option of a row off its default refuses any effect of the row.

    >>> next(line for line in pairs().splitlines() if line.startswith("| film thickness"))
    '| film thickness | `film`, `film_roughness`, `balance` | `film_law`, `soft_contact_film` |'
    """
    from mixedlub.chain.slots import SLIDING_POWER, STEPS
    from mixedlub.effects import catalogue
    from mixedlub.study.chosen_effects import AREA_ALONE

    effects = catalogue().values()
    chosen = {step: options for step, options in STEPS.items() if options}
    rows = [(step, options, [e.id for e in effects if e.replaces == step]) for step, options in chosen.items()]
    for words, options, acted in (
        ("contact area without the load of the asperities", AREA_ALONE, "area_ratio"),
        ("load at a point of the path", (SLIDING_POWER.option,), "load_share"),
    ):
        rows.append((words, options, [e.id for e in effects if acted in e.acts_on and not e.replaces]))
    return table(("step", "options", "effects"), ((step, _codes(one), _codes(other)) for step, one, other in rows))


def _codes(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)
