"""The Willmore flow, one step at a time."""

import dataclasses
import textwrap

from . import _core, errors
from ._arrays import vertices
from ._keywords import OF_STEPS
from ._options import check_names, keywords, python_names, warn
from ._run import Input, words_of


@dataclasses.dataclass(frozen=True)
class StepRecord:
    """What one step did.

    Attributes
    ----------
    step : int
        Counted from 1.
    time : float
        The sum of the time steps, in the unit of the flow: length^4, or length^2 with
        ``metric='identity'``.
    time_step : float
    energy : float
        E_b after the step, over the stencils that touch a vertex that can move: dimensionless, or
        length^2 without a mass matrix.
    gradient_norm : float
        The speed of the flow before the step, sqrt(<g, D^-1 g>).
    largest_move : float
        The largest move of a vertex in this step, length.
    """

    step: int
    time: float
    time_step: float
    energy: float
    gradient_norm: float
    largest_move: float


class Flow:
    """The semi-implicit Willmore flow as published, analysed and factored once.

    Each step solves J d = -h grad E(X) with the exact nonlinear gradient and the constant Jacobian
    J = D + h S of the positions at the start. With ``boundary='fair'`` open boundaries are smoothed
    first. Nothing guards the steps: on noisy meshes or with long steps the energy can rise; `smooth`
    checks every step.

    Parameters
    ----------
    V : array_like of shape (n, 3)
        Positions.
    F : array_like of shape (m, 3), list of faces, or packed faces
        Faces, vertex numbers counted from 0.
    fixed : array_like, optional
        The vertices that do not move: flags (n,) or numbers. Open boundaries are fixed as well, as
        `boundary` says.
    **options
        Keywords of `smooth`: {names}. The time step is `time_step`, or `cutoff` divided over
        `steps` (default 16) steps.

    Raises
    ------
    BadMesh, BadOption, FactorizationFailed, OutOfMemory

    References
    ----------
    Wardetzky, Bergou, Harmon, Zorin, Grinspun: Discrete Quadratic Curvature Energies, 2007,
    section 3.2.
    """

    def __init__(self, V, F=None, *, fixed=None, **options):
        known = {name: option for name, option in keywords("smooth").items() if name in OF_STEPS}
        check_names("Flow", options, known)
        if fixed is not None:
            if options.get("fix") is not None:
                raise TypeError("fixed and fix mean the same; give one of them")
            options["fix"] = fixed
        mesh = Input(V, F)
        words = ["smooth", "--plain", *words_of(mesh, options, known), "--", mesh.name, ""]
        with python_names():
            self._flow = _core.Flow(words, mesh.name, mesh.for_core())
        for warning in self._flow.warnings:
            warn(warning)

    @property
    def V(self):
        """ndarray of shape (n, 3): a copy of the state. Assigning other positions goes on from there
        with the same factorization, which fits as long as the lengths of the edges are nearly the
        same; steps and time are counted on."""
        return self._flow.positions()

    @V.setter
    def V(self, positions):
        self._flow.move_to(vertices(positions))

    @property
    def energy(self):
        """E_b at the state, over the stencils that touch a vertex that can move."""
        return self._flow.energy

    @property
    def time_step(self):
        """The length of a step, in the unit of the flow."""
        return self._flow.time_step

    @property
    def solver(self):
        """The name of the solver in use."""
        return self._flow.solver

    @property
    def fixed(self):
        """ndarray of bool, shape (n,): the vertices that do not move."""
        return self._flow.fixed.astype(bool)

    def step(self):
        """Makes one step.

        Returns
        -------
        StepRecord

        Raises
        ------
        NotReached
            If the energy would no longer be finite; the state is the one before the step.
        """
        record = self._flow.step()
        if record is None:
            raise errors.NotReached("the energy is no longer finite: the time step is too long for "
                                    "this mesh, or the mesh too noisy; `smooth` checks its steps")
        return StepRecord(**record)

    def steps(self, count):
        """Generates the records of `count` steps; each step is made when its record is asked for."""
        for _ in range(count):
            yield self.step()


if Flow.__doc__ is not None:  # as under python3 -OO
    Flow.__doc__ = Flow.__doc__.replace("{names}", textwrap.fill(
        ", ".join(f"`{name}`" for name in OF_STEPS), 88, subsequent_indent=" " * 8))
