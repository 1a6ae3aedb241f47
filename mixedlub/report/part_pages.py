"""Laws of machine parts as text: a table of all, and pages."""

from __future__ import annotations

from mixedlub.chain.part_law import GIVES, PartLaw
from mixedlub.parts import catalogue, of_kind, series
from mixedlub.report.format_reference import aligned
from profiles.errors import InputError, nearest


def parts_text(name: str | None = None) -> str:
    """Page of the laws with a name, or table of all laws in 80 columns."""
    if name is not None:
        found = [law for law in catalogue().values() if law.name == name]
        if not found:
            known = {law.name: law for law in catalogue().values()}
            raise InputError(f"no such law of a part; {nearest(name, known)}", where="LAW", value=name)
        return "\n\n".join(page(law) for law in found)
    lines = [f"{len(catalogue())} laws of machine parts. `mixedlub parts LAW` shows the page of one, and"]
    lines += ['law = "LAW" chooses it in a file of `mixedlub efficiency`. The number counts']
    lines += ["sources that confirm its constants; 0: as quoted in reviews, or yours."]
    for kind, gives in GIVES.items():
        lines += ["", f"{kind}: {gives}"]
        lines += aligned([(law.name, str(law.sources), law.status) for law in of_kind(kind).values()])
    return "\n".join(lines)


def page(law: PartLaw) -> str:
    """The page of a law, with the coefficients of its series."""
    known = series().get(law.series, {})
    if not known:
        return law.page()
    rows = [(name, ", ".join(f"{key} = {value:g}" for key, value in own.items())) for name, own in known.items()]
    return "\n".join([law.page(), "", "series", *aligned(rows)])
