"""Checkpoints of a run: one Parquet file per block, from which an interrupted run resumes.

A block's file is written to a temporary name and renamed, so it is complete or absent. The folder's name carries the
study's fingerprint: blocks of another study, or of other code, are never reused.
"""

from __future__ import annotations

import hashlib
import itertools
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.own_laws import text_of
from mixedlub.running.atomic import PARTS, whole
from mixedlub.running.origin import code_fingerprint
from mixedlub.study.batch import Found
from mixedlub.study.pieces import Block
from mixedlub.study.plan import Plan

if TYPE_CHECKING:
    import pyarrow as pa


def fingerprint(plan: Plan) -> str:
    """Hash of every number and every line of code that affects the results."""
    return hashlib.sha256(f"{code_fingerprint()}{input_fingerprint(plan)}".encode()).hexdigest()


def input_fingerprint(plan: Plan) -> str:
    """Hash of every number that affects the results."""
    digest = hashlib.sha256()
    ends = ([group.own, *(end for axis in group.axes for end in (axis.low, axis.high))] for group in plan.bands)
    for inputs in (plan.inputs, *itertools.chain(*ends)):
        for name in sorted(inputs):
            value = np.ascontiguousarray(inputs[name], dtype=float)
            digest.update(f"{name}{value.shape}".encode())
            digest.update(value.tobytes())
    for table in () if plan.heights is None else (plan.heights.area, plan.heights.load):
        digest.update(table.tobytes())
    if plan.flattening is not None:
        digest.update(plan.flattening.logs.tobytes())
    if plan.full is not None:
        for process in (plan.full.film, plan.full.stress):
            digest.update(np.ascontiguousarray(process.weights).tobytes())
    chosen = [plan.options.model_dump(), {k: dict(v) for k, v in plan.parameters.items()}, plan.shape]
    chosen += [] if plan.safety is None else [plan.safety.model_dump()]
    chosen += [text_of(law) for law in plan.laws.values()]
    digest.update(json.dumps(chosen, sort_keys=True).encode())
    return digest.hexdigest()


def parts_folder(out: Path, plan: Plan) -> Path:
    """Folder of the blocks of a study until it is complete."""
    return out / f"{PARTS}{fingerprint(plan)[:16]}"


def kept(folder: Path, todo: list[Block]) -> Iterator[tuple[Block, Found]]:
    """Blocks completed by an earlier run."""
    if not folder.is_dir():
        return
    import pyarrow as pa
    import pyarrow.parquet as pq

    for block in todo:
        path = folder / block_name(block)
        if not path.is_file():
            continue
        try:
            table = pq.read_table(path)
        except (OSError, pa.ArrowInvalid):
            continue
        shape = tuple(s.stop - s.start for s in block)
        if table.num_rows == np.prod(shape):
            yield block, {name: table[name].to_numpy().reshape(shape) for name in table.column_names}


def keep(folder: Path, block: Block, found: Found) -> None:
    """Save a completed block."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    folder.mkdir(parents=True, exist_ok=True)
    table = pa.table({name: floats(values) for name, values in found.items()})
    with whole(folder / block_name(block)) as aside:
        pq.write_table(table, aside, compression="none", use_dictionary=False)


def floats(values: np.ndarray) -> pa.Array:
    """A column of numbers, built without ``pa.array``, which imports pandas."""
    import pyarrow as pa

    flat = np.ascontiguousarray(values, dtype=float).ravel()
    return pa.Array.from_buffers(pa.float64(), flat.size, [None, pa.py_buffer(flat)])


def words(names: Sequence[str], index: np.ndarray) -> pa.Array:
    """A column of names by index, built like `floats`."""
    import pyarrow as pa

    encoded = [name.encode() for name in names]
    ends = np.cumsum(np.array([len(e) for e in encoded])[index], dtype=np.int32)
    offsets = pa.py_buffer(np.concatenate([np.zeros(1, np.int32), ends]))
    data = pa.py_buffer(b"".join(map(encoded.__getitem__, index.tolist())))
    return pa.StringArray.from_buffers(ends.size, offsets, data)


def block_name(block: Block) -> str:
    """File name of a block: its ranges."""
    return "_".join(f"{s.start}-{s.stop}" for s in block) + ".parquet"
