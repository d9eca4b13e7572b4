"""The functions give what the commands of the program give, to the bit, and leave their arguments
alone."""

import json

import numpy as np
import pytest

import ibmfair
from conftest import ROOT, SHARED, grid, program

REAL = ["models/bunny_4k_npm.obj", "models/hand_24192.off", "models/double-torus_6k_gpjs.obj",
        "models/suzanne_alec.obj", "models/spot_6k_alec.obj", "models/rbc_icosahedron_1.off",
        "reported/ball8_1.off", "reported/labels.off", "reported/plate14.off",
        "holes/fairing-cross_pmp.off"]
SHAPES = ["icosphere", "torus", "open", "noisy", "quads"]

pytestmark = pytest.mark.filterwarnings("ignore::ibmfair.MeshWarning")


def path_of(name, shapes):
    if name in shapes:
        return shapes[name]
    if not (SHARED / name).exists():
        pytest.skip(f"{SHARED / name} is not here")
    return SHARED / name


@pytest.mark.parametrize("name", SHAPES + REAL)
@pytest.mark.parametrize("options", [{}, {"cutoff": "5e", "twicing": 1, "keep_sharp": 30},
                                     {"denoise": True}], ids=str)
def test_smoothed_files_are_those_of_the_program(name, options, shapes, tmp_path):
    path = path_of(name, shapes)
    ours, theirs = tmp_path / f"ours{path.suffix}", tmp_path / f"theirs{path.suffix}"
    mesh = ibmfair.read(path)
    mesh.V, info = ibmfair.smooth(mesh, **options)
    mesh.write(ours)
    words = [f"--{name.replace('_', '-')}" + ("" if value is True else f"={value}")
             for name, value in options.items()]
    report = program("smooth", path, theirs, "--json", "--quiet", *words)
    assert ours.read_bytes() == theirs.read_bytes()
    assert info["after"] == report["after"]
    assert info["moved_vertices"] == report["moved_vertices"]


@pytest.mark.parametrize("name", ["open", "holed quads"] + [name for name in REAL if "holes/" in name])
def test_filled_meshes_are_those_of_the_program(name, shapes, tmp_path):
    path = path_of(name, shapes)
    mesh = ibmfair.read(path)
    V, F, info = ibmfair.fill(mesh)
    report = program("fill", path, tmp_path / f"filled{path.suffix}", "--json", "--quiet")
    filled = ibmfair.read(tmp_path / f"filled{path.suffix}")
    assert np.array_equal(V, filled.V)
    assert [list(face) for face in F] == [list(face) for face in filled.F]
    assert [hole["new_vertices"] for hole in info["holes"]] == \
        [hole["new_vertices"] for hole in report["holes"]]


def test_info_holes_and_compare_are_those_of_the_program(shapes):
    mesh = ibmfair.read(shapes["open"])
    assert ibmfair.holes(mesh) == program("holes", shapes["open"], "--json")["holes"]
    theirs = program("info", shapes["open"], "--json")
    ours = ibmfair.info(mesh)
    assert {key: ours[key] for key in ours if key not in ("arguments", "file")} == \
        {key: theirs[key] for key in theirs if key not in ("arguments", "file")}
    other = ibmfair.read(shapes["icosphere"])
    theirs = program("compare", shapes["open"], shapes["icosphere"], "--json")
    ours = ibmfair.compare(mesh.V, mesh.F, other.V, other.F)
    assert ours["surface_distance"] == theirs["surface_distance"]
    assert ibmfair.compare(mesh.V, mesh.F, sphere=1)["exact_surface"] == \
        program("compare", shapes["open"], "--sphere", "1", "--json")["exact_surface"]


def test_made_shapes_are_those_of_the_program(tmp_path):
    for shape, options in [("icosphere", {"subdivide": 3, "noise": 0.1, "seed": 7}),
                           ("torus", {"rows": 20}), ("cube", {"scale": 2, "move": [1, 0, -1]})]:
        V, F = ibmfair.make(shape, **options)
        words = [f"--{name}={','.join(map(str, value)) if isinstance(value, list) else value}"
                 for name, value in options.items()]
        program("make", shape, tmp_path / f"{shape}.ply", *words)
        made = ibmfair.read(tmp_path / f"{shape}.ply")
        assert np.array_equal(V, made.V) and np.array_equal(F, made.F)
    with pytest.raises(ibmfair.BadOption, match="icosphere"):
        ibmfair.make("icosphear")


def test_reports_follow_the_schema(opened):
    jsonschema = pytest.importorskip("jsonschema")
    schema = json.loads((ROOT / "data" / "report.schema.json").read_text())
    V, F = opened
    for report in [ibmfair.smooth(V, F, steps=2)[1], ibmfair.denoise(V, F)[1],
                   ibmfair.fill(V, F, all=True)[2], ibmfair.info(V, F),
                   ibmfair.compare(V, F, V), ibmfair.smooth(V, F, dry_run=True)[1]]:
        jsonschema.validate(report, schema)


FORMS = {
    "float32": lambda V, F: (V.astype(np.float32), F),
    "Fortran order": lambda V, F: (np.asfortranarray(V), np.asfortranarray(F)),
    "int64": lambda V, F: (V, F.astype(np.int64)),
    "uint16": lambda V, F: (V, F.astype(np.uint16)),
    "slices": lambda V, F: (np.repeat(V, 2, axis=0)[::2], np.repeat(F, 3, axis=1)[:, ::3]),
    "read only": lambda V, F: (frozen(V), frozen(F)),
    "lists": lambda V, F: (V.tolist(), F.tolist()),
    "packed": lambda V, F: (V, np.column_stack([np.full(len(F), 3), F]).ravel()),
    "list of arrays": lambda V, F: (V, list(F)),
}


def frozen(array):
    array = array.copy()
    array.flags.writeable = False
    return array


def test_new_vertices_fit_into_the_type_of_the_faces():
    V, F = ibmfair.make("icosphere", subdivide=2)
    F = F[V[F].mean(axis=1)[:, 2] < 0.5]
    expected = ibmfair.fill(V, F, edge_length="0.05u")[1]
    assert expected.max() > 255
    for given in (F.astype(np.uint8), np.column_stack([np.full(len(F), 3), F]).astype(np.uint8).ravel()):
        faces = ibmfair.fill(V, given, edge_length="0.05u")[1]
        corners = faces if faces.ndim == 2 else faces.reshape(-1, 4)[:, 1:]
        assert np.array_equal(corners, expected)


def test_stitched_faces_come_back(shapes):
    path = path_of("reported/tjunction.off", shapes)
    mesh = ibmfair.read(path)
    for arguments in [(mesh,), (mesh.V, mesh.F)]:
        V, F, info = ibmfair.fill(*arguments, stitch=True)
        assert len(F) == len(mesh.F) + 1 and ibmfair.holes(V, F) == []


@pytest.mark.parametrize("form", FORMS)
def test_any_form_of_arrays_gives_the_same(form, opened):
    V, F = opened
    V = V.astype(np.float32).astype(np.float64)
    given_V, given_F = FORMS[form](V, F)
    before_V, before_F = np.array(given_V), np.array(given_F)
    smoothed, _ = ibmfair.smooth(given_V, given_F, steps=3)
    assert np.array_equal(smoothed, ibmfair.smooth(V, F, steps=3)[0])
    assert smoothed.dtype == np.float64 and smoothed.flags.c_contiguous and smoothed.flags.owndata is False
    filled, faces, _ = ibmfair.fill(given_V, given_F, all=True)
    assert np.array_equal(filled[:len(V)], V)
    assert len(ibmfair.holes(filled, faces)) == 0
    assert type(faces) is type(given_F) or form == "list of arrays"
    assert np.array_equal(given_V, before_V) and np.array_equal(given_F, before_F)


def test_polygons_stay_polygons():
    V, F = grid(8)
    keep = np.arange(len(F)) != 27
    for given in [F[keep], F[keep].tolist(), np.column_stack([np.full(keep.sum(), 4), F[keep]]).ravel()]:
        filled, faces, _ = ibmfair.fill(V, given)
        if isinstance(given, np.ndarray) and given.ndim == 1:
            assert np.array_equal(faces[:len(given)], given)
        else:
            assert [list(face) for face in faces[:len(given)]] == [list(face) for face in given]


def test_arrays_choose_the_vertices_that_move(sphere):
    V, F = sphere
    north = V[:, 2] > 0.3
    smoothed, _ = ibmfair.smooth(V, F, mask=north)
    moved = (smoothed != V).any(axis=1)
    assert moved[north].mean() > 0.95 and not moved[~north].any()
    for mask in (north.astype(np.uint8), north.astype(float), np.flatnonzero(north), north.tolist()):
        assert np.array_equal(ibmfair.smooth(V, F, mask=mask)[0], smoothed)
    for fix in (np.flatnonzero(~north), ~north, (~north).astype(int)):
        assert np.array_equal(ibmfair.smooth(V, F, fix=fix)[0], smoothed)
    assert not (ibmfair.smooth(V, F, weights=north.astype(float))[0] != V).any(axis=1)[~north].any()
    both, _ = ibmfair.smooth(V, F, mask=north, fix=V[:, 0] > 0)
    assert not (both != V).any(axis=1)[~north | (V[:, 0] > 0)].any()
    region, faces, info = ibmfair.fill(V, F, region=north)
    assert np.array_equal(faces, F) and not (region != V).any(axis=1)[~north].any()


def test_an_array_of_spontaneous_curvature_is_a_number_everywhere(sphere):
    V, F = sphere
    options = {"laplacian": "lagrange", "steps": 2}
    number, _ = ibmfair.smooth(V, F, h0=np.float32(2), **options)
    assert np.array_equal(number, ibmfair.smooth(V, F, h0=np.full(len(V), 2.0), **options)[0])
    assert not np.array_equal(number, ibmfair.smooth(V, F, **options)[0])


def test_names_of_the_file_choose_vertices(tmp_path):
    V, F = grid(8)
    lines = [f"v {x} {y} {z}" for x, y, z in V]
    lines += ["g one"] + [f"f {' '.join(map(str, face + 1))}" for face in F[:40]]
    lines += ["g two"] + [f"f {' '.join(map(str, face + 1))}" for face in F[40:]]
    (tmp_path / "groups.obj").write_text("\n".join(lines) + "\n")
    mesh = ibmfair.read(tmp_path / "groups.obj")
    assert np.array_equal(np.flatnonzero(mesh.mask("two")), np.unique(F[40:]))
    smoothed, _ = ibmfair.smooth(mesh, mask="two", boundary="position")
    moved = (smoothed != mesh.V).any(axis=1)
    assert moved.any() and not moved[~mesh.mask("two")].any()


def test_a_mesh_keeps_what_its_file_holds(shapes):
    mesh = ibmfair.read(path_of("models/spot_6k_alec.obj", shapes))  # has texture coordinates
    expected, _ = ibmfair.smooth(mesh)
    everything = np.ones(len(mesh.V))
    for options in ({"fix": []}, {"mask": everything}, {"mask": np.arange(len(mesh.V))}):
        assert np.array_equal(ibmfair.smooth(mesh, **options)[0], expected)
    assert not np.array_equal(ibmfair.smooth(mesh.V, mesh.F)[0], expected)
    mesh.V = mesh.V * 2
    assert np.allclose(ibmfair.smooth(mesh)[0], 2 * expected, rtol=0, atol=1e-4)
    with pytest.raises(AttributeError):
        mesh.F = mesh.F


def test_empty_lists_of_holes_fill_nothing_and_entries_are_numbers(opened):
    V, F = opened
    for nothing in ([], (), np.array([], int), set(), (hole for hole in [])):
        assert np.array_equal(ibmfair.fill(V, F, holes=nothing)[1], F)
    holes = ibmfair.holes(V, F)
    expected = ibmfair.fill(V, F, holes=[0])[0]
    for chosen in (holes, {0}, np.array([0]), 0, "0", np.int64(0), range(1)):
        assert np.array_equal(ibmfair.fill(V, F, holes=chosen)[0], expected)


def test_numbers_of_any_kind(sphere):
    from fractions import Fraction
    V, F = sphere
    expected, _ = ibmfair.smooth(V, F, cutoff=5, steps=3, keep_volume=True)
    for five, three, true in [(np.float32(5), np.int64(3), np.bool_(True)), (5.0, 3.0, True),
                              (Fraction(5), np.float64(3), True), ("5e", "3", True)]:
        assert np.array_equal(
            ibmfair.smooth(V, F, cutoff=five, steps=three, keep_volume=true)[0], expected)


def test_merged_vertices_share_a_position(sphere):
    V, F = sphere
    soup = V[F].reshape(-1, 3)
    smoothed, _ = ibmfair.smooth(soup, np.arange(len(soup)).reshape(-1, 3), weld=True, steps=4)
    assert smoothed.shape == soup.shape
    _, first = np.unique(F.ravel(), return_index=True)
    assert np.array_equal(smoothed, smoothed[first][F.ravel()])
    assert (smoothed != soup).any(axis=1).mean() > 0.95


def test_warnings_are_python_warnings_and_nothing_is_printed(opened, capfd):
    V, F = opened
    with pytest.warns(ibmfair.MeshWarning) as caught:
        ibmfair.smooth(V, np.vstack([F, F[:1]]), steps=1)
    assert caught[0].filename == __file__
    for call in (lambda: ibmfair.fill(V, np.vstack([F, F[:1]])), lambda: ibmfair.denoise(V, np.vstack([F, F[:1]])),
                 lambda: ibmfair.Flow(V, np.vstack([F, F[:1]]))):
        with pytest.warns(ibmfair.MeshWarning) as others:
            call()
        assert {warning.filename for warning in others} == {__file__}
    assert "--" not in str(caught[0].message)
    with pytest.raises(ibmfair.BadMesh):
        ibmfair.smooth(V, np.vstack([F, F[:1]]), steps=1, strict=True)
    ibmfair.fill(V, F, all=True)
    ibmfair.info(V, F), ibmfair.holes(V, F), ibmfair.compare(V, F, V)
    assert capfd.readouterr() == ("", "")


def test_reports_and_pictures_are_written(opened, tmp_path, monkeypatch, capfd):
    V, F = opened
    reports = [tmp_path / "report.json", tmp_path / "report.csv"]
    ibmfair.smooth(V, F, steps=2, report=reports, picture=tmp_path / "picture.png")
    assert json.loads(reports[0].read_text())["status"] == "completed"
    assert reports[1].read_text().count("\n") == 3
    assert (tmp_path / "picture.png").read_bytes()[1:4] == b"PNG"
    with pytest.raises(ibmfair.CannotWrite):
        ibmfair.smooth(V, F, steps=2, report=reports[0])
    monkeypatch.chdir(tmp_path)
    ibmfair.smooth(V, F, steps=2, report="-")
    assert json.loads((tmp_path / "-").read_text())["status"] == "completed"
    assert capfd.readouterr() == ("", "")
    for wrong in ("a\0.json", tmp_path / "no--such" / "a.json"):
        with pytest.raises(ValueError if isinstance(wrong, str) else ibmfair.CannotWrite) as raised:
            ibmfair.smooth(V, F, steps=2, report=wrong)
    assert "no--such" in str(raised.value)


def test_progress_is_told_and_may_end_the_run(sphere):
    V, F = sphere
    told = []
    ibmfair.denoise(V, F, progress=lambda stage, share: told.append((stage, share)))
    assert told and all(isinstance(stage, str) and (share is None or 0 <= share <= 1)
                        for stage, share in told)

    class Enough(Exception):
        pass

    for when in ("", "step"):
        def stop(stage, share):
            if stage.startswith(when):
                raise Enough(stage)

        with pytest.raises(Enough) as raised:
            ibmfair.smooth(V, F, steps=300, progress=stop)
        assert raised.traceback[-1].name == "stop"
        if when:
            assert (raised.value.V != V).any() and raised.value.info["status"] == "interrupted"
        else:
            assert raised.value.V is None and raised.value.info is None
