"""Bad arguments: a ValueError or TypeError that says what is wrong, never a crash, a hang or a result."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import ibmfair

TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]]), \
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])

hundreds = settings(max_examples=300, deadline=None, database=None,
                    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
pytestmark = pytest.mark.filterwarnings("ignore::ibmfair.MeshWarning")

anything = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5), st.binary(max_size=5),
    st.lists(st.integers(-5, 9), max_size=5), st.dictionaries(st.text(max_size=2), st.integers()),
    arrays.arrays(st.sampled_from([np.float64, np.int32, np.int64, np.uint8, bool, np.complex64]),
                  arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5)))


def is_mesh(V, F):
    """Whether the arrays are a mesh by the rules of the documentation."""
    V = np.asarray(V)
    return V.ndim == 2 and V.shape[1] == 3 and len(V) > 0 and np.isfinite(V).all()


@given(V=anything)
@hundreds
def test_vertices_of_any_kind(V):
    try:
        result, _ = ibmfair.smooth(V, TETRAHEDRON[1], steps=1)
    except (ValueError, TypeError) as error:
        assert str(error)
    else:
        assert is_mesh(V, TETRAHEDRON[1]) and result.shape == np.shape(V)


@given(F=anything)
@hundreds
def test_faces_of_any_kind(F):
    try:
        ibmfair.smooth(TETRAHEDRON[0], F, steps=1)
    except (ValueError, TypeError) as error:
        assert str(error)
    else:
        corners = np.asarray(F)
        assert corners.dtype.kind in "iubf" and corners.min() >= 0 and corners.max() <= 4


@given(V=arrays.arrays(np.float64, st.tuples(st.integers(1, 8), st.just(3)),
                       elements=st.floats(-1e300, 1e300)),
       F=arrays.arrays(np.int64, st.tuples(st.integers(1, 12), st.just(3)),
                       elements=st.integers(0, 7)),
       steps=st.integers(0, 3), fills=st.booleans())
@hundreds
def test_any_numbers_in_well_formed_arrays(V, F, steps, fills):
    try:
        if fills:
            result, _, _ = ibmfair.fill(V, F, all=True, max_new_vertices=50)
            result = result[:len(V)]
            assert np.array_equal(result, V)
        else:
            result, _ = ibmfair.smooth(V, F, steps=steps)
    except ibmfair.Error as error:
        assert str(error)
    except ValueError as error:
        assert F.max() >= len(V) and "names vertex" in str(error)
    else:
        assert result.shape == V.shape and np.isfinite(result).all()


values = st.one_of(st.none(), st.booleans(), st.integers(-3, 10**6), st.floats(), st.text(max_size=8),
                   st.lists(st.floats(), max_size=4), st.just(np.ones(4)), st.just(object()))


@given(name=st.sampled_from(["cutoff", "steps", "time_step", "max_move", "keep_sharp", "weights",
                             "boundary", "fix", "mask", "laplacian", "h0", "anisotropy", "mass",
                             "metric", "twicing", "tangential", "solver", "solver_tolerance",
                             "memory", "weld", "threads", "denoise", "plain"]), value=values)
@hundreds
def test_options_of_any_value(name, value):
    if isinstance(value, int) and abs(value) > 1000 and name in ("steps", "twicing", "threads"):
        return  # valid, and long
    try:
        result, _ = ibmfair.smooth(*TETRAHEDRON, **{"steps": 2, name: value})
    except (ValueError, TypeError, ibmfair.Error) as error:
        assert str(error)
        assert "--" not in str(error)
    else:
        assert np.isfinite(result).all()


def message(call, kind=ValueError):
    with pytest.raises(kind) as raised:
        call()
    return str(raised.value)


def test_messages_name_the_place():
    V, F = TETRAHEDRON
    assert "row 2 is not finite" in message(lambda: ibmfair.smooth([*V[:2], [0, math.nan, 0], V[3]], F))
    assert "face 1 names vertex 9" in message(lambda: ibmfair.smooth(V, [[0, 1, 2], [1, 2, 9]]))
    assert "(n, 3)" in message(lambda: ibmfair.smooth(V[:, :2], F))
    assert "(m, 3)" in message(lambda: ibmfair.smooth(V, F[:, :2]))
    assert "did you mean 'cutoff'" in message(lambda: ibmfair.smooth(V, F, cutof=3), TypeError)
    assert "lagrange" in message(lambda: ibmfair.smooth(V, F, laplacian="lagrang"))
    assert "4 vertices" in message(lambda: ibmfair.smooth(V, F, weights=[1, 1]))
    assert "lagrange" in message(lambda: ibmfair.energy(V, F, "lagrang"))
    assert "transposed" in message(lambda: ibmfair.smooth(*ibmfair.make("icosphere", subdivide=2)[:1],
                                                          ibmfair.make("icosphere", subdivide=2)[1].T))
    assert "packed" in message(lambda: ibmfair.smooth(V, np.column_stack([np.full(9, 3)] + [range(9)] * 3)))
    assert "masked" in message(lambda: ibmfair.smooth(np.ma.masked_greater(V, 0.5), F))
    assert "string" in message(lambda: ibmfair.energy(V, F, 3), TypeError)
    assert "callable" in message(lambda: ibmfair.smooth(V, F, progress=3), TypeError)
    assert "denoise" in message(lambda: ibmfair.denoise(V, F, denoise=False), TypeError)
    assert "F is missing" in message(lambda: ibmfair.smooth(V), TypeError)


def test_errors_are_those_of_the_exit_codes(tmp_path):
    (tmp_path / "broken.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n")
    with pytest.raises(ibmfair.BadFile, match="broken.off:4") as raised:
        ibmfair.read(tmp_path / "broken.off")
    assert raised.value.exit_code == 3
    with pytest.raises(ibmfair.BadOption) as raised:
        ibmfair.smooth(*TETRAHEDRON, steps=-1)
    assert raised.value.exit_code == 2
    with pytest.raises(ibmfair.BadMesh) as raised:
        ibmfair.smooth(TETRAHEDRON[0] * 0, TETRAHEDRON[1])
    assert raised.value.exit_code == 4
    with pytest.raises(ibmfair.OutOfMemory) as raised:
        ibmfair.smooth(*TETRAHEDRON, memory="1k")
    assert raised.value.exit_code == 5 and isinstance(raised.value, MemoryError)
    with pytest.raises(ibmfair.CannotWrite) as raised:
        ibmfair.write(tmp_path / "no" / "folder.ply", *TETRAHEDRON)
    assert raised.value.exit_code == 6 and isinstance(raised.value, OSError)
