"""Smooths a mesh with VTK's windowed sinc filter: an alternative to `ibmfair smooth`, for
tools/bench. Prints the seconds of the smoothing.

    vtk_smooth.py IN.ply OUT.ply ITERATIONS PASS_BAND
"""

import sys
import time

import vtk

reader = vtk.vtkPLYReader()
reader.SetFileName(sys.argv[1])
reader.Update()
smoother = vtk.vtkWindowedSincPolyDataFilter()
smoother.SetInputConnection(reader.GetOutputPort())
smoother.SetNumberOfIterations(int(sys.argv[3]))
smoother.SetPassBand(float(sys.argv[4]))
smoother.NormalizeCoordinatesOn()
start = time.perf_counter()
smoother.Update()
print(time.perf_counter() - start)
writer = vtk.vtkPLYWriter()
writer.SetInputConnection(smoother.GetOutputPort())
writer.SetFileName(sys.argv[2])
writer.Write()
