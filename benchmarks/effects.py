"""What an effect costs beside a base model that makes what the effect reads: the dearest three on each rig.

One line a figure: name, figure, unit, ratio to its reference; the reference is five base evaluations.
Run: python benchmarks/effects.py
"""

from __future__ import annotations

import sys
from pathlib import Path
from time import perf_counter

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Model
from tests.contracts.rigs import RIGS, acting, moved, rig

MOST = 5.0
CALLS = 40


def times(name: str, effect: Effect) -> float:
    """Shortest time with an effect over the shortest without, the calls in turn."""
    inputs, want = rig(name).inputs, ("reading", *effect.acts_on, *effect.reads)
    models = [Model(rig(name).chain, tuple(inputs), want, effects) for effects in ((), (effect,))]
    values = [{}, {effect.id: moved(effect)}]
    shortest = [np.inf, np.inf]
    for _ in range(CALLS):
        for k, (model, parameters) in enumerate(zip(models, values, strict=True)):
            start = perf_counter()
            model(inputs, parameters)
            shortest[k] = min(shortest[k], perf_counter() - start)
    return shortest[1] / shortest[0]


def main() -> None:
    # The two laws of a sample's viscosity are no measure; its effects are timed on the other rigs.
    for name in RIGS:
        if name != "viscosity":
            found = sorted(((times(name, e), e.id) for e in acting(name)), reverse=True)
            for ratio, effect_id in found[:3]:
                print(f"{effect_id} on {name}, {ratio:.3g}, base evaluations, {MOST / ratio:.3g}", flush=True)


if __name__ == "__main__":
    main()
