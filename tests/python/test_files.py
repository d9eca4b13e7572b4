"""Mesh files through arrays, and arrays through other packages."""

import numpy as np
import pytest

import ibmfair
from conftest import SHARED, grid


@pytest.mark.parametrize("extension", ["ply", "off", "obj"])
def test_files_keep_every_number(extension, tmp_path):
    V = np.random.default_rng(3).normal(size=(169, 3)) * 10.0 ** np.arange(-60, 109)[:, None]
    _, F = grid(12)
    path = tmp_path / f"mesh.{extension}"
    ibmfair.write(path, V, F)
    mesh = ibmfair.read(path)
    assert np.array_equal(mesh.V, V) and np.array_equal(mesh.F, F)
    mesh.write(tmp_path / f"again.{extension}")
    assert (tmp_path / f"again.{extension}").read_bytes() == path.read_bytes()


def test_only_what_moved_changes_in_the_file(tmp_path):
    text = "# a comment\nv 0 0 0 0.5 0.25 1\nv 1.50 0 0 1 0 0\nv 0 1 0 0 1 0\nvt 0 0\ng part\nf 1/1 2/1 3/1\n"
    (tmp_path / "a.obj").write_text(text)
    mesh = ibmfair.read(tmp_path / "a.obj")
    V = mesh.V.copy()
    V[1, 0] = 2
    mesh.V = V
    report = mesh.write(tmp_path / "b.obj")
    assert report["patched"] and report["moved_vertices"] == 1
    assert (tmp_path / "b.obj").read_text() == text.replace("1.50", "2")
    with pytest.raises(ibmfair.CannotWrite):
        mesh.write(tmp_path / "a.obj")
    mesh.write(tmp_path / "a.obj", overwrite=True)
    with pytest.raises(ValueError):
        mesh.V = V[:2]
    with pytest.raises(ibmfair.BadOption):
        mesh.write(tmp_path / "b.xyz")


def test_values_at_vertices(tmp_path):
    (tmp_path / "a.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float quality\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0.5\n1 0 0 0\n0 1 0 2\n3 0 1 2\n")
    mesh = ibmfair.read(tmp_path / "a.ply")
    assert mesh.values("quality").tolist() == [0.5, 0, 2] and mesh.values("other") is None
    assert mesh.mask("quality").tolist() == [True, False, True]


def round_trip(convert, back):
    """Fills the hole of a mesh that another package holds, and gives it back."""
    V, F = grid(8)
    F = np.delete(F, 27, axis=0)
    F = np.vstack([F[:, :3], F[:, [0, 2, 3]]])
    other = convert(V, F)
    V2, F2, _ = ibmfair.fill(*back(other))
    again_V, again_F = back(convert(V2, F2))
    assert np.array_equal(again_V, V2)
    assert np.array_equal(np.asarray(again_F).ravel(), np.asarray(F2).ravel())
    assert len(V2) >= len(V) and len(ibmfair.holes(V2, F2)) == 1


def test_round_trip_with_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    round_trip(lambda V, F: meshio.Mesh(V, [("triangle", F)]),
               lambda mesh: (mesh.points, mesh.cells_dict["triangle"]))
    V, F = grid(4)
    meshio.Mesh(V, [("quad", F)]).write(tmp_path / "a.ply")
    mesh = ibmfair.read(tmp_path / "a.ply")
    assert np.array_equal(mesh.V, V) and np.array_equal(mesh.F, F)


def test_round_trip_with_trimesh():
    trimesh = pytest.importorskip("trimesh")
    round_trip(lambda V, F: trimesh.Trimesh(V, F, process=False), lambda mesh: (mesh.vertices, mesh.faces))


def test_round_trip_with_pyvista():
    pyvista = pytest.importorskip("pyvista")
    packed = lambda F: F if np.ndim(F) == 1 else np.column_stack([np.full(len(F), 3), F]).ravel()  # noqa: E731
    round_trip(lambda V, F: pyvista.PolyData(V, packed(F)), lambda mesh: (mesh.points, mesh.faces))


def test_the_errors_of_files_are_those_of_the_program():
    if not SHARED.exists():
        pytest.skip(f"{SHARED} is not here")
    from conftest import PROGRAM
    import subprocess
    compared = 0
    for path in sorted((SHARED / "malformed").rglob("*")):
        if path.suffix not in (".obj", ".ply", ".off"):
            continue
        run = subprocess.run([PROGRAM, "info", path], capture_output=True, text=True)
        if run.returncode != 3:
            continue
        with pytest.raises(ibmfair.BadFile) as raised:
            ibmfair.read(path)
        message = run.stderr.splitlines()[-1].removeprefix("ibmfair: error: ")
        assert str(raised.value) == message.replace("--input-format", "input_format")
        compared += 1
    assert compared > 20
