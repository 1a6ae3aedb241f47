"""Starvation."""

from mixedlub.effect import BetweenLog, LogNormal, Parameter, effect


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(0.4, 0.8),
            "power with which the film falls far above onset",
            null=0.0,
            symbol="s",
        ),
        Parameter("onset", "N/m", BetweenLog(0.01, 1.0), "viscosity times speed at which oil runs short", symbol="c"),
        Parameter("steepness", "-", LogNormal(2.5, 0.4), "how sharply starvation sets in", symbol=r"\gamma"),
    ),
    equation=r"h \leftarrow h\,\left[1 + (\eta_0 u / c)^{\gamma}\right]^{-s/\gamma}",
    source="F. Chevalier, A. A. Lubrecht, P. M. E. Cann, F. Colin, G. Dalmaz, J. Tribol. 120 (1998) 126, with the "
    "supply taken as fixed; the onset follows P. M. E. Cann, B. Damiens, A. A. Lubrecht, Tribol. Int. 37 (2004) 859",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "slide_roll_ratio": "-"},
    separated_by="an oil flow or jet position sweep: more oil lifts the onset to higher speed, whereas inlet heating "
    "does not change",
)
def starvation(film_thickness, viscosity, entrainment_speed, *, strength, onset, steepness):
    """Too little oil reaches the inlet above a certain viscosity times speed, and the film falls behind.

    Chevalier and others write h/h_ff = r/(1 + r^gamma)^(1/gamma) with gamma 2 to 5 and r the supplied over the fully
    flooded film; here r = (c/(eta u))^s. Power s is 0.1 for a meniscus at fixed distance (Hamrock and Dowson)
    and 0.7 for a film that cannot grow any more.

    >>> starvation(1.0, 0.1, 1.0, strength=1.0, onset=0.1, steepness=1.0)   # r = 1, gamma = 1
    0.5
    """
    return film_thickness * (1.0 + (viscosity * entrainment_speed / onset) ** steepness) ** (-strength / steepness)
