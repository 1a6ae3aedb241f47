"""Shear thinning in the inlet."""

from mixedlub.effect import Between, BetweenLog, Parameter, effect


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter("index", "-", Between(0.6, 0.97), "power-law index n of the oil", null=1.0),
        Parameter("critical_stress", "Pa", BetweenLog(3e3, 1e6), "stress at which thinning begins"),
        Parameter("plateau", "-", Between(0.0, 0.9), "share of the film that full thinning leaves"),
    ),
    equation=r"h \leftarrow h\,\bigl\{c + (1 - c)\bigl[1 + 0.79\,((1+S)N)^{1/(1+0.2S)}\bigr]^{-3.6(1-n)^{1.7}}\bigr\},"
    r"\quad N = \eta_0 u/(h G_{cr})",
    source="S. Bair, Proc. IMechE J 219 (2005) 69; constants as quoted in the literature",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "-"},
    separated_by="film thickness of the same base oil without polymer, or a viscometer at high shear rate: thinning "
    "follows shear stress in the inlet, heating follows viscosity times speed squared",
    valid={"slide_roll_ratio": (0.0, 2.0)},
    after=("inlet_shear_heating", "starvation"),
)
def inlet_shear_thinning(
    film_thickness, viscosity, entrainment_speed, slide_roll_ratio, *, index, critical_stress, plateau
):
    """Polymers align in the inlet, the oil thins, and the film is below that of a Newtonian oil.

    Against an inlet solution within 10 % for N up to 1.6 and 16 % for N 31 at n = 0.75; use for n above 0.6.
    An oil with polymer has a second Newtonian plateau mu_2/mu_1 and keeps at least (mu_2/mu_1)^0.69 of its film,
    the exponent of viscosity in the film law.

    >>> h = inlet_shear_thinning(0.2e-6, 15e-3, 2.0, 0.0, index=0.75, critical_stress=5e3, plateau=0.0)
    >>> round(0.2e-6 / float(h), 1)   # N = 30
    3.0
    """
    group = (1.0 + slide_roll_ratio) * viscosity * entrainment_speed / (film_thickness * critical_stress)
    thinning = 1.0 + 0.79 * group ** (1.0 / (1.0 + 0.2 * slide_roll_ratio))
    return film_thickness * (plateau + (1.0 - plateau) * thinning ** (-3.6 * (1.0 - index) ** 1.7))
