"""Notebooks run from beginning to end, and are stored with what they show."""

import os
from pathlib import Path

import nbclient
import nbformat
import pytest
import snell

FOLDER = Path(__file__).parents[1] / "notebooks"
NAMES = ["two-interface.ipynb", "your-mesh.ipynb"]


def ran(notebook: nbformat.NotebookNode, folder: Path) -> nbformat.NotebookNode:
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}}).execute()
    return notebook


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_runs_and_its_assertions_hold(name: str, tmp_path: Path) -> None:
    fresh = ran(nbformat.read(FOLDER / name, as_version=4), tmp_path)
    if os.environ.get("BLESS") == "notebooks":
        for cell in fresh.cells:
            cell.metadata.pop("execution", None)
        nbformat.write(fresh, FOLDER / name)


@pytest.mark.parametrize("name", NAMES)
def test_a_notebook_is_stored_with_its_outputs_and_small(name: str) -> None:
    stored = nbformat.read(FOLDER / name, as_version=4)
    code = [cell for cell in stored.cells if cell.cell_type == "code"]
    assert sum(bool(cell.outputs) for cell in code) >= 4
    assert any("<figure>" in str(cell.outputs) for cell in code)
    assert not any(output.output_type == "error" for cell in code for output in cell.outputs)
    assert (FOLDER / name).stat().st_size < 400_000


def test_a_wrong_statement_stops_a_notebook(tmp_path: Path) -> None:
    """The control: the same notebook with one bound made impossible, and its twin."""

    def with_bound(bound: str) -> nbformat.NotebookNode:
        text = f"import snell\nvalue = len(snell.call('scenes'))\nassert value > {bound}, value"
        return nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text)])

    ran(with_bound("1"), tmp_path)
    with pytest.raises(nbclient.exceptions.CellExecutionError, match="AssertionError"):
        ran(with_bound("10_000"), tmp_path)
    assert len(snell.call("scenes")) > 1
