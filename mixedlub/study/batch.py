"""The batch engine: a factorial in blocks, computed in pieces that fit the cache, on threads or a cluster.

Every quantity has length one on axes it does not depend on, so quantities independent of the surfaces (film, pressure,
shear) are computed once for all pairings.
"""

from __future__ import annotations

import copy
import ctypes
import itertools
import os
import platform
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import replace
from functools import cache

import numpy as np

from mixedlub.chain.model import Model, Step
from mixedlub.chain.ranges import farthest_beyond
from mixedlub.laws.balance import share_lacking
from mixedlub.laws.contact import asperity_load_ratio, asperity_real_pressure, mean_hertz_pressure
from mixedlub.laws.load import carries_load
from mixedlub.laws.loss import over_path
from mixedlub.running.cluster import on_cluster
from mixedlub.study.bands import band, losses_at_ends
from mixedlub.study.columns import loss_of
from mixedlub.study.derived import following
from mixedlub.study.pieces import PIECE_PAIRINGS, PIECE_POINTS, Block, Inputs, reach, split, taken
from mixedlub.study.plan import Plan

OUTPUTS = (
    "power_loss",
    "mean_friction",
    "area_ratio",
    "film_thickness",
    "film_parameter",
    "composite_roughness",
    "mesh_loss",
    "rolling_loss",
    "other_loss",
    "hertz_pressure",
    "asperity_load_ratio",
    "asperity_real_pressure",
    "plain_mean_friction",
    "least_film",
    "flash_temperature",
)
SPUR = ("load_loss_factor",)
"""Additional outputs of spur gears."""
SHARED = ("mean_asperity_load_share", "film_over_unbalanced")
"""Additional outputs if film and asperities share the load."""
RATED = ("mean_flash",)
"""Additional outputs of a study with limits of the oil."""
RATED_FILMS = ("least_specific_film",)
"""Additional outputs of a study with a limit of the film."""
CHECKS = ("largest_area_ratio",)
SHARED_CHECKS = ("balance_error", "share_lacking")
"""Additional checks if film and asperities share the load."""
FILM_OVER_WIDTH = "film_over_contact_width"
"""Check: largest ratio of film thickness to Hertz contact width along the path."""
BEYOND = "beyond_"
"""Prefix of a limit's key: value farthest beyond its range, NaN if all are within."""
BLOCK_POINTS = 4_000_000

Found = dict[str, np.ndarray]


def processors() -> int:
    """Number of processors available to this process; all of the machine if the system does not report them."""
    own = getattr(os, "sched_getaffinity", None)
    return len(own(0)) if own is not None else os.cpu_count() or 1


def blocks(plan: Plan) -> list[Block]:
    """Units of work, each saved on completion, so that an interrupted run repeats only unfinished blocks."""
    return split(plan.shape, reach(plan.shape, plan.points, BLOCK_POINTS, plan.shape[0]))


def names(plan: Plan) -> tuple[str, ...]:
    """Names of the outputs and checks of a plan, without ends of bands."""
    shared = (*SHARED, *SHARED_CHECKS) if plan.balanced else ()
    losses = map(loss_of, plan.losing)
    return (
        *OUTPUTS,
        *(SPUR if plan.spur else ()),
        *losses,
        *(RATED if plan.safety is not None else ()),
        *(RATED_FILMS if plan.rates_films else ()),
        *CHECKS,
        FILM_OVER_WIDTH,
        *shared,
        *(BEYOND + limit.key for limit in plan.limits),
    )


def compute(plan: Plan, block: Block) -> Found:
    """Outputs, checks and ends of bands of a block in SI, each of the block's shape."""
    found = _computed(plan, block)
    if not plan.bands:
        return found

    inputs = taken(plan.inputs, block)
    outputs = (*OUTPUTS, *(SHARED if plan.balanced else ()), *(RATED_FILMS if plan.rates_films else ()))

    def with_following(found: Found) -> Found:
        return {**{name: found[name] for name in outputs}, **following(plan, inputs, found)}

    def at(moved: Inputs) -> Found:
        return with_following(_computed(replace(plan, inputs={**plan.inputs, **moved}), block))

    spread = []
    for group in plan.bands:
        own = with_following(found) if group is plan.bands[0] else at(group.own)
        spread.append((own, [(at(axis.low), at(axis.high)) for axis in group.axes]))
    return found | band(spread, tuple(spread[0][0])) | losses_at_ends(spread)


def _computed(plan: Plan, block: Block) -> Found:
    shape = tuple(s.stop - s.start for s in block)
    found = {name: np.empty(shape) for name in names(plan)}
    with np.errstate(all="ignore"):
        _fill(plan, block, found)
    return found


def _fill(plan: Plan, block: Block, found: Found) -> None:
    shape = tuple(s.stop - s.start for s in block)
    common, own = stages(plan.model(), plan.inputs)
    inputs = taken(plan.inputs, block)
    size = reach(shape, plan.points, PIECE_POINTS, PIECE_PAIRINGS)
    for conditions in split((1, *shape[1:]), (1, *size[1:])):
        shared = taken(inputs, (slice(None), *conditions[1:]))
        shared.update(common(shared, plan.parameters))
        for start in range(0, shape[0], size[0]):
            pairings = slice(start, min(start + size[0], shape[0]))
            piece = taken(shared, (pairings,))
            piece.update(own(piece, plan.parameters))
            for name, values in reduced(piece, plan).items():
                found[name][(pairings, *conditions[1:])] = values[..., 0]


def stages(model: Model, inputs: Inputs) -> tuple[Model, Model]:
    """The model split into the steps independent of the surfaces and the remaining steps."""
    varying = {name for name, value in inputs.items() if np.ndim(value) == 5 and np.shape(value)[0] > 1}
    common: list[Step] = []
    own: list[Step] = []
    read: set[str] = set()
    for step in model.steps:
        if varying.intersection((*step.reads, *step.outputs)) or read.intersection(step.outputs):
            own.append(step)
            varying.update(step.outputs)
            read.update(step.reads)
        else:
            common.append(step)
    made = {name for step in common for name in step.outputs}
    return _part(model, common, sorted(made.intersection((*read, *model.want)))), _part(model, own, model.want)


def _part(model: Model, steps: Sequence[Step], want: Sequence[str]) -> Model:
    part = copy.copy(model)
    part.steps, part.want = tuple(steps), tuple(want)
    return part


def reduced(state: Inputs, plan: Plan) -> Found:
    """Results of a piece with the mesh axis reduced to one; unloaded points count in no mean and no check.

    Checks and loads of asperities cover the points counted by `carries_load`.
    """
    film, area, pressure, weight = (state[n] for n in ("film_thickness", "area_ratio", "hertz_pressure", "mean_weight"))
    loaded = weight > 0
    everywhere = bool(loaded.all())
    judged = carries_load(state["line_load"])
    mean_pressure = mean_hertz_pressure(pressure)
    # The largest ratio of pressures is sought where that of area to pressure is: that costs no integral a point.
    hardest = (area * (judged / mean_pressure)).argmax(axis=-1, keepdims=True)

    def there(value: np.ndarray) -> np.ndarray:
        return value if np.ndim(value) == 0 or value.shape[-1] == 1 else np.take_along_axis(value, hardest, axis=-1)

    def largest(value: np.ndarray) -> np.ndarray:
        return value.max(axis=-1, keepdims=True) if everywhere else _largest(value, loaded)

    carried = plan.asperities(*(there(state[name]) for name in plan.asperities_read))
    touching = there(area)
    mean_film = over_path(film, weight)
    in_mesh = state["mesh_loss"] + state["rolling_loss"]
    found = {
        "power_loss": state["power_loss"],
        "mean_friction": state["mean_friction"],
        "area_ratio": np.minimum(over_path(area, weight), 1.0),  # a mean of ones may round to more
        "film_thickness": mean_film,
        "film_parameter": mean_film / state["composite_roughness"],
        "composite_roughness": state["composite_roughness"],
        "mesh_loss": state["mesh_loss"],
        "rolling_loss": state["rolling_loss"],
        "other_loss": state["power_loss"] - in_mesh,
        "hertz_pressure": largest(pressure),
        "asperity_load_ratio": asperity_load_ratio(carried, there(mean_pressure)),
        "asperity_real_pressure": asperity_real_pressure(carried, touching),
        "largest_area_ratio": touching,
        FILM_OVER_WIDTH: _largest(_over_width(state), judged),
        "plain_mean_friction": over_path(state["friction"], weight),
        "least_film": np.min(film, axis=-1, keepdims=True, where=everywhere or loaded, initial=np.inf),
        "flash_temperature": largest(state["flash_temperature"]),
        **_rated(state, loaded, plan),
        **{name: state[name] for name in (*(SPUR if plan.spur else ()), *map(loss_of, plan.losing))},
        **(_shared(state, judged, mean_pressure) if plan.balanced else {}),
    }
    for limit in plan.limits:
        found[BEYOND + limit.key] = farthest_beyond(state[limit.quantity], limit.ends, judged)
    return found


def _rated(state: Inputs, loaded: np.ndarray, plan: Plan) -> Found:
    """Values compared with the limits of a study: mean flash temperature, and least film over mean roughness."""
    if plan.safety is None:
        return {}
    found = {"mean_flash": over_path(state["flash_temperature"], state["mean_weight"])}
    if plan.rates_films:
        film = state["specific_film"]
        found["least_specific_film"] = np.min(film, axis=-1, keepdims=True, where=loaded, initial=np.inf)
    return found


def _over_width(state: Inputs) -> np.ndarray:
    """Film thickness over the width of the Hertz contact, 2 b = 8 R p_0 / E'."""
    width = 8.0 * state["radius"] * state["hertz_pressure"] / state["reduced_modulus"]
    return np.asarray(state["film_thickness"] / width)


def _largest(value: np.ndarray, where: np.ndarray) -> np.ndarray:
    return np.max(value, axis=-1, keepdims=True, where=where, initial=0.0)


def _shared(state: Inputs, judged: np.ndarray, mean_pressure: np.ndarray) -> Found:
    """Outputs and checks of a piece if film and asperities share the load; checks and load ratio are maxima."""
    share, of_film, weight = state["asperity_pressure"] / mean_pressure, state["film_load_share"], state["mean_weight"]
    return {
        "asperity_load_ratio": _largest(share, judged),
        "mean_asperity_load_share": over_path(share, weight),
        "film_over_unbalanced": over_path(state["film_thickness"] / state["full_load_film"], weight),
        "balance_error": _largest(np.abs(share + of_film - 1.0), judged),
        "share_lacking": _largest(share_lacking(of_film, state["least_film_share"]), judged),
    }


def run(
    plan: Plan, todo: Sequence[Block] | None = None, *, scheduler: str | None = None, threads: int | None = None
) -> Iterator[tuple[Block, Found]]:
    """Compute blocks on threads or a cluster; yields them in order of completion.

    On threads of this machine, or on the workers of the Dask scheduler at an address; block function and numbers are
    the same on processors of one kind.
    """
    todo = blocks(plan) if todo is None else todo
    if scheduler is not None:
        yield from on_cluster(compute, plan, todo, scheduler)
        return
    pin_allocator()
    threads = threads or processors()
    if threads == 1 or len(todo) < 2:
        for block in todo:
            yield block, compute(plan, block)
        return
    queue = iter(todo)
    with ThreadPoolExecutor(threads) as pool:
        running = {pool.submit(compute, plan, b): b for b in itertools.islice(queue, 2 * threads)}
        while running:
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(done), done.result()
                for block in itertools.islice(queue, 1):
                    running[pool.submit(compute, plan, block)] = block


@cache
def pin_allocator() -> bool:
    """Make glibc keep the pages of freed arrays (process-wide); two to four times faster. Returns whether it was set.

    Without it every temporary array is returned to the system and allocated again page by page.
    MIXEDLUB_PIN_ALLOCATOR=0 leaves the allocator alone.
    """
    if os.environ.get("MIXEDLUB_PIN_ALLOCATOR") == "0" or platform.libc_ver()[0] != "glibc":
        return False
    libc = ctypes.CDLL(None)
    trim_threshold, top_pad, mmap_threshold, size = -1, -2, -3, 1 << 28
    return all(libc.mallopt(option, size) == 1 for option in (trim_threshold, top_pad, mmap_threshold))
