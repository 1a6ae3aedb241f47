"""Viscous drag of a drive that grows less than in proportion to speed."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="shear",
    acts_on="viscous_torque",
    parameters=(
        Parameter("deficit", "-", LogNormal(0.35, 0.35), "one less the flow index of the grease", null=0.0, symbol="d"),
    ),
    equation=r"T_v \leftarrow T_v\,\max(|\omega/\omega_0|,\ 10^{-6})^{-d}",
    source="W. H. Herschel, R. Bulkley, Kolloid-Z. 39 (1926) 291, power-law part",
    fingerprint={"speed": "-"},
    separated_by="speeds over two decades: the drag bends in a log-log plot, and has no minimum as Stribeck friction",
    kinds=("friction_map",),
)
def grease_shear_thinning(
    viscous_torque: np.ndarray, drive_speed: np.ndarray, reference_speed: np.ndarray, *, deficit: float
) -> np.ndarray:
    """Grease thins as it is sheared; its drag grows with a power of speed below one.

    Drag that hardly grows with speed, with a deficit near one, is Coulomb's and not that of a grease.

    >>> round(float(grease_shear_thinning(1.0, 25.0, 100.0, deficit=0.5)), 3)
    2.0
    """
    share = np.maximum(np.abs(drive_speed) / reference_speed, 1e-6)
    return viscous_torque * share ** (-deficit)
