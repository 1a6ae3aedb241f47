"""Roughness inside the film: its pressure presses long waves flat and leaves short ones."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.powers import power

LINE_WAVE = (0.17, 0.03)
"""C. H. Venner, A. A. Lubrecht, Proc. IMechE J 213 (1999) 397, the constants of line contacts."""


def amplitude_left(reduction: np.ndarray) -> np.ndarray:
    r"""Amplitude of a wave inside a rolling line contact over its amplitude outside (-).

    .. math:: \frac{A_d}{A_i} = \frac{1}{1 + 0.17\,\nabla + 0.03\,\nabla^2}

    of Venner's number :math:`\nabla = (\lambda_w/b_H)\,M^{3/4} L^{-1/2}`. Source: C. H. Venner, F. Couhier, A. A.
    Lubrecht, J. A. Greenwood, Tribology Series 32 (1997) 103, for the number and the solutions; C. H. Venner, A. A.
    Lubrecht, Proc. IMechE J 213 (1999) 397, for the fit.

    >>> round(float(amplitude_left(100.0**0.75 / 11.0**0.5)), 3)   # wave of b at M 100, L 11; their solution: 0.183
    0.187
    """
    return 1.0 / (1.0 + LINE_WAVE[0] * reduction + LINE_WAVE[1] * reduction**2)


def reduction_rate(moes_load: np.ndarray, moes_material: np.ndarray) -> np.ndarray:
    r"""Venner's number of a transverse wave over its length in half widths (-), :math:`M^{3/4} L^{-1/2}`.

    M = W (2U)^{-1/2} and L = G (2U)^{1/4}. With it `amplitude_left` is within 5 % of solutions for wavelengths up to
    one half width, too large a reduction above. Source: as `amplitude_left`.

    >>> round(float(amplitude_left(0.25 * reduction_rate(100.0, 11.0))), 2)   # a quarter of b; solution: 0.66
    0.63
    """
    return np.asarray(power(moes_load, 0.75) * power(moes_material, -0.5))


def flattening_rate(
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    line_load: np.ndarray,
    viscosity: np.ndarray,
    pressure_viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
) -> np.ndarray:
    r"""Venner's number of a wave over its length (1/m), from M, L and the half width of a line contact.

    .. math:: \frac{M^{3/4}}{b_H L^{1/2}} = \frac{1}{R}\sqrt{\frac{\pi}{8}}\,\frac{W^{1/4}}{\sqrt{2 U G}}

    Source: C. H. Venner, F. Couhier, A. A. Lubrecht, J. A. Greenwood, Tribology Series 32 (1997) 103.

    >>> rate = flattening_rate(8.3262e-3, 2.163, 214.86e3, 0.01489, 14.81e-9, 226.374e9)
    >>> round(float(rate * 60e-6), 2)   # a wave of 60 um
    1.38
    """
    speed = viscosity * entrainment_speed / (reduced_modulus * radius)
    load = line_load / (reduced_modulus * radius)
    material = pressure_viscosity * reduced_modulus
    return np.sqrt(np.pi / 8.0) * power(load, 0.25) / (radius * np.sqrt(2.0 * speed * material))


def lay_factor(orientation: float) -> float:
    r"""Factor on Venner's number for the lay (-), :math:`e^{1 - 1/\gamma}` where :math:`\gamma > 1`, else 1.

    :math:`\gamma` is the length of waves along the motion over their length across it: ridges along the motion flatten
    more. The factor is of circular contacts. Source: C. H. Venner, A. A. Lubrecht, Proc. IMechE J 214 (2000) 121.

    >>> [round(lay_factor(one), 3) for one in (0.2, 1.0, 9.0)]
    [1.0, 1.0, 2.432]
    """
    return float(np.exp(1.0 - 1.0 / max(orientation, 1.0)))


def kept_moments(lengths: np.ndarray, shares: np.ndarray, rates: np.ndarray, cutoffs: np.ndarray) -> np.ndarray:
    r"""Moments inside the film over the moments outside (-): axes moment, rate and short cut-off.

    .. math:: \frac{m_n'}{m_n} = \sum_w s_{n,w}\,A(\lambda_w g)^2\,e^{-2\pi(\alpha\lambda_c/\lambda_w)^2},\quad
              \alpha = \sqrt{\ln 2/\pi}

    with the shares :math:`s_{n,w}` of the waves in the moment, the amplitude A at the rate g, and the Gaussian filter
    of ISO 16610-21 with the cut-off :math:`\lambda_c`, 0 for none.

    >>> one = kept_moments(np.array([60e-6]), np.ones((3, 1)), np.array([0.0, 1.1 / 60e-6]), np.array([0.0, 60e-6]))
    >>> (one[0] ** 0.5).round(2).tolist()   # half the amplitude is left at the cut-off
    [[1.0, 0.5], [0.82, 0.41]]
    """
    left = amplitude_left(np.multiply.outer(rates, lengths)) ** 2
    passed = np.exp(-2.0 * np.log(2.0) * np.divide.outer(cutoffs, lengths) ** 2)
    return np.einsum("nw,gw,cw->ngc", shares, left, passed, optimize=True)
