"""Figures 4 to 10 of Hong, Aneshansley and Talbot at the width of a column."""

import numpy as np
import pytest
from matplotlib.text import Text

from mixedlub.cli import main
from mixedlub.report.paper_figures import SHAPES, WIDTH, paper_figures
from mixedlub.study import read_study, run_study
from tests.study.conftest import study_file


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return run_study(read_study(study_file(tmp_path_factory.mktemp("paper"), conditions__torque_Nm=[50, 100, 150])))


@pytest.fixture(scope="module")
def drawn(results):
    return {one.name: one for one in paper_figures(results)}


def test_there_is_one_for_each_figure_of_the_paper(drawn):
    assert [name.split("_")[1] for name in drawn] == ["04", "05", "06", "07", "08", "09", "10"]


@pytest.fixture(scope="module")
def long_names(tmp_path_factory):
    moments = {"m2": 0.0025, "m4_per_um2": 0.0036}
    names = ("isotropic finish A12", "superfinished flank", "ground, shot peened")
    surfaces = {name: {"m0_um2": 0.02 * 4**i, **moments} for i, name in enumerate(names)}
    folder = tmp_path_factory.mktemp("long")
    return {f"long names: {one.name}": one for one in paper_figures(run(study_file(folder, surfaces=surfaces)))}


def run(file):
    return run_study(read_study(file))


def test_text_is_readable_and_nothing_overlaps(drawn, long_names):
    for name, one in (drawn | long_names).items():
        figure = one.figure
        figure.draw_without_rendering()
        assert figure.get_figwidth() == WIDTH
        shown = [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip()]
        assert min(t.get_fontsize() for t in shown) >= 6.0, name
        (legend,) = figure.legends
        parts = [legend, *(axes for axes in figure.axes if axes.get_visible())]
        boxes = [part.get_tightbbox() for part in parts]
        assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i]), name
        assert all(box.x0 >= 0 and box.x1 <= figure.bbox.x1 for box in boxes), name


def test_every_axis_has_quantity_and_unit(drawn):
    for name, one in drawn.items():
        labels = [one.figure.get_supylabel(), one.figure.get_supxlabel(), *(a.get_xlabel() for a in one.figure.axes)]
        labels = [text for text in labels if text]
        assert len(labels) == 2, name
        assert all("(" in text for text in labels), name


@pytest.mark.parametrize("number", [9, 10])
def test_every_condition_is_a_mark_hollow_where_out_of_range(results, drawn, number):
    (panel,) = next(one for name, one in drawn.items() if f"_{number:02}_" in name).figure.axes
    marks = [line for line in panel.lines if line.get_marker() in SHAPES]
    count = sum(line.get_xdata().size for line in marks)
    hollow = sum(line.get_xdata().size for line in marks if isinstance(line.get_markerfacecolor(), str))
    assert count == results["power_loss"][:, 0].size
    assert hollow == results.outside[:, 0].sum()
    highest = max(line.get_ydata().max() for line in marks if line.get_xdata().size)
    assert highest == results["normalised_loss"][:, 0].max()


def test_lines_over_roughness_are_those_of_the_fits(results, drawn):
    panels = drawn["paper_08_loss_over_composite_roughness"].figure.axes
    assert [panel.get_title(loc="left") for panel in panels] == ["(a) 50 N m", "(b) 100 N m", "(c) 150 N m"]
    lines = [line for line in panels[2].lines if line.get_linestyle() == "-"]
    x, y = lines[1].get_data()
    fit = np.polyfit(results["composite_roughness"][:, 0, 2, 1] * 1e6, results["normalised_loss"][:, 0, 2, 1], 1)
    assert y == pytest.approx(np.polyval(fit, x))


def test_one_pairing_and_long_names_are_drawn_too(write_study):
    moments = {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036}
    few = run(write_study(surfaces={"superfinished, vibratory, batch 12": moments}))
    assert len(list(paper_figures(few))) == 7


def test_panels_without_a_pairing_are_left_out(long_names):
    panels = long_names["long names: paper_04_normalised_loss_equal"].figure.axes
    assert [panel.get_visible() for panel in panels] == [True, True, True, False]
    labelled = [any(text.get_visible() and text.get_text() for text in panel.get_xticklabels()) for panel in panels[:3]]
    assert labelled[1:] == [True, True]


def test_bands_are_shaded(write_study):
    surfaces = {"traced": {"profile": "shipped:0258", "cutoff_mm": 0.8}}
    banded = run(write_study(surfaces=surfaces, options={"bands": "traces"}))
    drawn = {one.name: one for one in paper_figures(banded)}
    for quantity, most in (("area_ratio", 1.0), ("normalised_loss", banded["power_loss"].max())):
        (one,) = (d for name, d in drawn.items() if f"_{quantity}_equal" in name)
        assert "Shaded: in 90 of 100 surfaces" in one.caption
        (panel,) = one.figure.axes
        ends = banded["highest_" + quantity.replace("normalised", "power")][0, 0, 0] / most
        assert panel.collections[0].get_paths()[0].vertices[:, 1].max() == pytest.approx(ends.max())


def test_the_command_draws_them_on_request_with_text_as_text(write_study, tmp_path, capsys):
    """Every figure of the command in two formats, those of the paper among them."""
    few = {"conditions__oil_temperature_C": [60], "conditions__torque_Nm": [50], "surfaces__mid": None}
    path, out = write_study(**few), tmp_path / "o"
    assert main(["study", str(path), "--paper-figures", "--format", "svg,pdf", "--out", str(out)]) == 0
    names = {path.name for path in (out / "figures").iterdir()}
    stems = {name.rpartition(".")[0] for name in names}
    assert names == {f"{stem}.{form}" for stem in stems for form in ("svg", "pdf")}
    assert sum(stem.startswith("paper_") for stem in stems) == 7
    equal = next(stem for stem in stems if stem.startswith("power_loss_equal"))
    assert "pinion speed (rpm)</text>" in (out / "figures" / f"{equal}.svg").read_text(encoding="utf-8")
    assert (out / "figures" / f"{equal}.pdf").read_bytes().startswith(b"%PDF")
    assert 'href="figures/paper_04_normalised_loss_equal.svg"' in (out / "index.html").read_text(encoding="utf-8")
    assert main(["study", str(path), "--paper-figures", "--no-figures", "--out", str(out)]) == 2
    assert "--paper-figures" in capsys.readouterr().err
