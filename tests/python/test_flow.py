"""The flow step by step, energies and matrices: laws of the paper, by finite differences and against
each other."""

import threading
import time

import numpy as np
import pytest

import ibmfair
from conftest import noisy

LAPLACIANS = ["crouzeix-raviart", "lagrange", "weighted", "intrinsic-delaunay", "umbrella"]


@pytest.fixture
def bumpy(shapes):
    mesh = ibmfair.read(shapes["torus"])
    return noisy(mesh.V, 0.02), np.array(mesh.F)


@pytest.mark.parametrize("laplacian", LAPLACIANS)
def test_the_gradient_is_the_derivative_of_the_energy(laplacian, bumpy):
    V, F = bumpy
    E, G = ibmfair.energy(V, F, laplacian, gradient=True)
    assert E == ibmfair.energy(V, F, laplacian) and G.shape == V.shape
    direction = np.random.default_rng(2).normal(size=V.shape)
    h = 1e-6
    difference = (ibmfair.energy(V + h * direction, F, laplacian)
                  - ibmfair.energy(V - h * direction, F, laplacian)) / (2 * h)
    assert difference == pytest.approx((G * direction).sum(), rel=1e-5)


def test_the_energy_is_that_of_the_matrices(shapes):
    sparse = pytest.importorskip("scipy.sparse")
    mesh = ibmfair.read(shapes["icosphere"])  # closed: all nodes are inner nodes
    for name, size in [("lagrange", len(mesh.V)),
                       ("crouzeix-raviart", len(ibmfair.edges(mesh.V, mesh.F)))]:
        L, M = ibmfair.laplacian(mesh.V, mesh.F, name)
        assert sparse.issparse(L) and L.shape == M.shape == (size, size)
        X = mesh.V
        if name == "crouzeix-raviart":
            X = X[ibmfair.edges(mesh.V, mesh.F)].mean(axis=1)
        assert abs(L - L.T).max() == 0 and abs(L @ np.ones(size)).max() < 1e-12
        LX = L @ X
        energy = 0.5 * (LX * (LX / M.diagonal()[:, None])).sum()
        assert energy == pytest.approx(ibmfair.energy(mesh.V, mesh.F, name), rel=1e-9)
        assert energy == pytest.approx(8 * np.pi, rel=0.02)  # 1/2 integral (2 / r)^2


def test_open_boundaries_are_those_of_the_plain_flow(opened):
    V, F = opened
    V = noisy(V, 0.05)
    for boundary in ("fixed", "position", "free", "fair"):
        flow = ibmfair.Flow(V, F, cutoff=6, steps=3, boundary=boundary)
        list(flow.steps(3))
        expected, _ = ibmfair.smooth(V, F, cutoff=6, steps=3, boundary=boundary, plain=True)
        assert np.abs(flow.V - expected).max() < 1e-9


def test_threads_take_turns_at_a_flow(bumpy):
    V, F = bumpy
    alone, shared = (ibmfair.Flow(V, F, laplacian="lagrange", cutoff=6) for _ in range(2))
    list(alone.steps(40))
    threads = [threading.Thread(target=lambda: list(shared.steps(10))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert shared.energy == alone.energy


@pytest.mark.parametrize("laplacian", ["crouzeix-raviart", "lagrange"])
def test_steps_are_those_of_the_plain_flow(laplacian, bumpy):
    V, F = bumpy
    flow = ibmfair.Flow(V, F, laplacian=laplacian, cutoff=6, steps=5)
    records = list(flow.steps(5))
    expected, info = ibmfair.smooth(V, F, laplacian=laplacian, cutoff=6, steps=5, plain=True)
    assert np.abs(flow.V - expected).max() < 1e-9 * np.abs(V).max()
    assert [record.energy for record in records] == \
        pytest.approx([step["energy"] for step in info["steps"]], rel=1e-9)
    assert flow.energy == records[-1].energy < records[0].energy


def test_steps_are_made_when_they_are_asked_for(bumpy):
    V, F = bumpy
    flow = ibmfair.Flow(V, F, cutoff=6)
    steps = flow.steps(1000)
    assert np.array_equal(flow.V, V)
    first = next(steps)
    after_one = flow.V
    next(steps)
    assert first.step == 1 and not np.array_equal(flow.V, after_one)
    flow.V = V
    assert next(flow.steps(1)).energy == pytest.approx(first.energy, rel=1e-12)
    assert np.allclose(flow.V, after_one, rtol=0, atol=1e-12)


def test_fixed_vertices_stay(opened):
    V, F = opened
    fixed = V[:, 0] > 0
    flow = ibmfair.Flow(V, F, laplacian="lagrange", fixed=fixed)
    flow.step()
    moved = (flow.V != V).any(axis=1)
    assert moved.any() and not moved[flow.fixed].any() and flow.fixed[fixed].all()


def test_a_flow_that_blows_up_says_so_and_keeps_its_state(bumpy):
    V, F = bumpy
    with pytest.raises(ibmfair.BadMesh):
        ibmfair.Flow(V, F, fixed=np.ones(len(V), bool))
    flow = ibmfair.Flow(V, F)
    with pytest.raises(ibmfair.BadMesh):
        flow.V = np.zeros_like(V)
    with pytest.raises(ValueError):
        flow.V = V[:-1]
    assert np.array_equal(flow.V, V)


def best(call, times=5):
    """The shortest time of several calls, seconds."""
    seconds = []
    for _ in range(times):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    return min(seconds)


def test_a_flow_in_use_is_three_times_as_fast_as_single_calls(shapes):
    mesh = ibmfair.read(shapes["icosphere"])
    flow = ibmfair.Flow(mesh.V, mesh.F, laplacian="lagrange", cutoff=6)
    again = best(flow.step)
    anew = best(lambda: ibmfair.smooth(mesh.V, mesh.F, laplacian="lagrange", cutoff=6, steps=1))
    print(f"a step of a Flow {1e3 * again:.2f} ms, smooth with one step {1e3 * anew:.2f} ms")
    assert anew > 3 * again
