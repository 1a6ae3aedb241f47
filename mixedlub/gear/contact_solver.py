"""Points in contact and their loads: the linear complementarity problem of rigid approach.

Batched: the first axis of every array is independent problems (mesh phases times torques).
"""

from __future__ import annotations

import numpy as np


def share_out(
    compliance: np.ndarray,
    gap: np.ndarray,
    total: np.ndarray,
    possible: np.ndarray,
    start: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Forces, approach and touching points under a total force.

    Find F >= 0 and the approach d with C F + gap = d + Y, Y >= 0, F Y = 0, sum(F) = total: the optimality conditions of
    minimising F'CF/2 + gap'F, strictly convex for positive definite C.

    ``compliance`` (S, n, n), ``gap`` (S, n), ``total`` (S,) > 0, ``possible`` (S, n) points that may touch, ``start``
    (S, n) a first guess of the touching points. Returns forces (S, n), approach (S,), touching (S, n). All wrong points
    are exchanged at once, which settles contact problems in a few rounds; unsettled problems then descend one exchange
    at a time from a feasible point, which cannot cycle.

    Source: Conry and Seireg 1971 for the statement; Hintermuller, Ito and Kunisch 2002 for the exchange of all at once;
    Nocedal and Wright 2006, algorithm 16.3, for the descent.

    >>> force, approach, touching = share_out(
    ...     np.eye(2)[None], np.array([[0.0, 5.0]]), np.array([3.0]), np.ones((1, 2), bool), np.ones((1, 2), bool))
    >>> print(force, approach)
    [[3. 0.]] [3.]
    """
    problems, size = gap.shape
    touching = start & possible
    touching[~touching.any(axis=1)] = possible[~touching.any(axis=1)]
    force, approach = np.zeros((problems, size)), np.zeros(problems)
    left = np.arange(problems)
    scale = np.einsum("sii->s", compliance) / size
    for _ in range(12):
        trial, offset = _equalise(compliance[left], gap[left], total[left], touching[left])
        separation = _separation(compliance[left], gap[left], trial, offset)
        tolerance = 1e-13 * scale[left, None] * total[left, None]
        wanted = np.where(touching[left], trial > 0, separation < -tolerance) & possible[left]
        force[left], approach[left] = trial, offset
        settled = (wanted == touching[left]).all(axis=1)
        touching[left[~settled]] = wanted[~settled]
        left = left[~settled]
        if left.size == 0:
            break
    for problem in left:
        answer = descend(
            compliance[problem], gap[problem], total[problem], possible[problem], force[problem], scale[problem]
        )
        force[problem], approach[problem], touching[problem] = answer
    return force, approach, touching


def _equalise(
    compliance: np.ndarray, gap: np.ndarray, total: np.ndarray, touching: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Forces and approach when exactly the given points touch; the others carry no load."""
    problems, size = gap.shape
    scale = np.einsum("sii->s", compliance) / size
    both = touching[:, :, None] & touching[:, None, :]
    system = np.zeros((problems, size + 1, size + 1))
    system[:, :size, :size] = np.where(both, compliance / scale[:, None, None], 0)
    system[:, range(size), range(size)] += ~touching
    system[:, :size, size] = -1.0 * touching
    system[:, size, :size] = touching
    right = np.zeros((problems, size + 1, 1))
    right[:, :size, 0] = np.where(touching, -gap / (scale * total)[:, None], 0)
    right[:, size, 0] = 1
    answer = np.linalg.solve(system, right)[..., 0]
    return answer[:, :size] * total[:, None] * touching, answer[:, size] * scale * total


def stiffness_of(compliance: np.ndarray, touching: np.ndarray) -> np.ndarray:
    """Slope (S,) of the total force over the approach while the given points touch.

    >>> stiffness_of(np.diag([0.5, 0.25, 1.0])[None], np.array([[True, True, False]]))
    array([6.])
    """
    _, slope = _equalise(compliance, np.zeros(touching.shape), np.ones(len(touching)), touching)
    return 1 / slope


def _separation(compliance: np.ndarray, gap: np.ndarray, force: np.ndarray, approach: np.ndarray) -> np.ndarray:
    return np.einsum("sij,sj->si", compliance, force) + gap - approach[:, None]


def descend(
    compliance: np.ndarray,
    gap: np.ndarray,
    total: float,
    possible: np.ndarray,
    guess: np.ndarray,
    scale: float,
) -> tuple[np.ndarray, float, np.ndarray]:
    """One problem by the primal active-set method; the energy falls with every exchange."""
    force = np.where(possible, np.maximum(guess, 0), 0)
    force *= total / force.sum()
    touching = force > 0
    for _ in range(50 * gap.size):
        trials, offsets = _equalise(compliance[None], gap[None], np.array([total]), touching[None])
        trial, offset = trials[0], float(offsets[0])
        if np.all(trial >= 0):
            force = trial
            separation = np.where(possible & ~touching, compliance @ force + gap - offset, 0)
            worst = int(np.argmin(separation))
            if separation[worst] >= -1e-13 * scale * total:
                return force, offset, touching
            touching[worst] = True
            continue
        falling = np.flatnonzero(trial < 0)
        steps = force[falling] / (force[falling] - trial[falling])
        blocking = falling[int(np.argmin(steps))]
        force = force + steps.min() * (trial - force)
        force[blocking] = 0
        touching[blocking] = False
    raise ArithmeticError("the load distribution did not settle")
