"""A film that stays when the speed goes to nothing."""

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="film_thickness",
    parameters=(
        Parameter("thickness", "m", LogNormal(4e-9, 0.8), "thickness of the layer", null=0.0, symbol="h_b"),
        Parameter(
            "joining", "-", LogNormal(2.0, 0.4), "1: layer and film add up; large: the thicker alone", symbol="m"
        ),
    ),
    equation=r"h \leftarrow (h^m + h_b^m)^{1/m}",
    source="layers below the reach of entrainment: G. Guangteng, H. A. Spikes, Tribol. Trans. 39 (1996) 448; joined "
    "so that it fades at speed, by the root of squares or more sharply",
    fingerprint={"speed": "-"},
    separated_by="a zero check at rest before and after: a drifted zero shifts all films, a layer only the thinnest",
    after=("inlet_shear_heating", "inlet_shear_thinning", "starvation", "roughness_lay"),
    kinds=("film",),
)
def boundary_film(film_thickness, *, thickness, joining):
    """Adsorbed or reacted layers hold the surfaces apart where the fluid film would be thinner than they are.

    >>> [round(boundary_film(h, thickness=4e-9, joining=2.0) * 1e9, 2) for h in (3e-9, 400e-9)]
    [5.0, 400.02]
    """
    return film_thickness * (1.0 + (thickness / film_thickness) ** joining) ** (1.0 / joining)
