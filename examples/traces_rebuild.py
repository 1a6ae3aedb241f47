"""How the constants of the shipped traces were found: bend a Gaussian texture until Ra, Rq, Rz are right.

Prints, for each trace, the fitted constants beside those of its recipe, then what roughness measures on the
shipped trace beside the published table, with its moments and McCool asperities. Run it with
``python examples/traces_rebuild.py``; the traces themselves come from ``python -m profiles.traces.build``.
"""

import numpy as np
from scipy.optimize import least_squares
from scipy.special import ndtri

from profiles import Profile, shipped
from profiles.synthesise import fitted_tails, ra_rq_rz, reshape_tails, uniform
from profiles.traces import SHIPPED
from profiles.traces.build import envelope, recipes, texture, waves
from roughness import height_parameters, moments, roughness_profile

SECTIONS = 6


def filtered(heights: np.ndarray, spacing: float) -> np.ndarray:
    """Heights after the filters of the table: lambda_s 2.5 um, lambda_c 0.8 mm."""
    return roughness_profile(Profile(heights, spacing), cutoff=0.8e-3, short_cutoff=2.5e-6).heights


def fitted_bending(recipe: dict) -> dict:
    """rms (um), cubic and extremes that give Ra, Rq, Rz; gains that give each sampling length that Rq."""
    spacing = recipe["spacing_um"] * 1e-6
    base, long = texture(recipe)
    table = [recipe[key] * 1e-6 for key in ("Ra_um", "Rq_um", "Rz_um")]
    gains = np.ones(SECTIONS)
    for _ in range(30):
        gain = envelope(gains, base.size)

        def measure(heights: np.ndarray, gain: np.ndarray = gain) -> tuple[float, float, float]:
            return ra_rq_rz(filtered(heights * gain, spacing), SECTIONS)

        rms, cubic, extremes = fitted_tails(Profile(base, spacing), *table, measure, long, recipe["knee"])
        band = filtered(reshape_tails(base, rms, cubic, extremes, long, recipe["knee"]) * gain, spacing)
        if not recipe["evened"]:
            break
        uneven = np.array([np.sqrt(np.mean(part**2)) for part in np.array_split(band, SECTIONS)]) / table[1]
        if np.abs(uneven - 1).max() < 1e-5:
            break
        gains /= uneven
    return {"rms_um": rms * 1e6, "cubic": cubic, "extremes": extremes, "gains": gains}


def fitted_waves(recipe: dict) -> np.ndarray:
    """Wave coefficients (um) that give Ra, Rq and Rz and keep the bulk of the heights Gaussian.

    Unknown are a cosine and a sine for each period; wanted are the three parameters and the rms height of
    the whole, to 1e-5, and heights on the line of the normal distribution within two rms, with no more wave
    than that needs.
    """
    spacing = recipe["spacing_um"] * 1e-6
    base, _ = texture(recipe)
    bent = reshape_tails(base, recipe["rms_um"] * 1e-6, recipe["cubic"], recipe["extremes"])
    fixed = filtered(bent, spacing) * 1e6
    units = np.eye(2 * len(recipe["wave_periods_mm"]))
    each = np.column_stack([filtered(waves(recipe, unit), spacing) * 1e6 for unit in units])
    target = np.array([recipe["Ra_um"], recipe["Rq_um"], recipe["Rz_um"]])
    rq = recipe["Rq_um"]
    ranks = np.arange(40, fixed.size, 160)
    line = rq * ndtri((ranks + 0.5) / fixed.size)
    bulk = np.abs(line) < 2 * rq

    def miss(coefficients: np.ndarray, weight: float) -> np.ndarray:
        heights = fixed + each @ coefficients
        off_table = np.append(np.array(ra_rq_rz(heights, SECTIONS)) / target, np.std(heights) / rq) - 1
        off_line = (np.sort(heights)[ranks] - line)[bulk] / rq
        return np.concatenate([weight * off_table, 0.6 * off_line, 0.03 * coefficients / rq])

    draws = uniform(recipe["wave_seed"], 2 * units.shape[0])
    start = 0.3 * rq * np.sqrt(-2 * np.log(draws[::2])) * np.cos(2 * np.pi * draws[1::2])
    for weight in (300.0, 30000.0):
        start = least_squares(miss, start, args=(weight,), diff_step=1e-5, max_nfev=100).x
    return start


def main() -> None:
    for name, recipe in recipes().items():
        found = {"wave_coefficients_um": fitted_waves(recipe)} if recipe["wave_periods_mm"] else fitted_bending(recipe)
        for key, value in found.items():
            print(f"{name}  {key}: fitted {np.round(value, 6).tolist()}, recipe {recipe[key]}")
    print("\nname      Ra    Rq    Rz (um)   m0 (um2)    m2       m4 (1/um2)  alpha   R (um)  D (1/mm2)")
    for name in SHIPPED:
        band = roughness_profile(shipped(name), cutoff=0.8e-3, short_cutoff=2.5e-6)
        heights, m = height_parameters(band), moments(band)
        radius = 0.375 * np.sqrt(np.pi / m.m4)
        density = m.m4 / (m.m2 * 6 * np.pi * np.sqrt(3))
        print(
            f"{name}   {heights.Ra * 1e6:.3f} {heights.Rq * 1e6:.3f} {heights.Rz * 1e6:.3f}"
            f"     {m.m0 * 1e12:.6f}  {m.m2:.3e}  {m.m4 * 1e-12:.3e}  {m.bandwidth:6.2f}"
            f"   {radius * 1e6:6.2f}   {density * 1e-6:.0f}"
        )


if __name__ == "__main__":
    main()
