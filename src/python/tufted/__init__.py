"""Laplacians of point clouds and triangle meshes, and algorithms on them.

PointCloud, Mesh and read build L and M, and have all algorithms as methods. point_cloud_laplacian, mesh_laplacian,
PointCloudHeatSolver and the mesh solvers have the names and arguments of robust_laplacian and potpourri3d.

L is minus the Laplacian, integrated: symmetric, positive semidefinite. M holds areas. Poisson equation: L u = M f.
Eigenproblem: L x = lambda M x.
"""
from ._clouds import Mesh, PointCloud, denoise, load, read, thin
from ._drop_in import (MeshHeatMethodDistanceSolver, MeshVectorHeatSolver, PointCloudHeatSolver, compute_distance,
                       compute_distance_multisource, mesh_laplacian, point_cloud_laplacian, read_mesh,
                       read_point_cloud)
from ._results import (Curvature, Deformation, Denoised, Gradients, Isoline, LogMap, MinimalSurface, Parameterization,
                       Path, Segments, Spectrum, Trace)
from ._surface import Surface, TuftedWarning
from ._tufted import Cancelled, FileTooLarge, InvalidInput, IoError, SolverFailure
from ._tufted import version as __version__

__all__ = [
    "Cancelled", "Curvature", "Deformation", "Denoised", "FileTooLarge", "Gradients", "InvalidInput", "IoError", "Isoline", "LogMap", "Mesh",
    "MeshHeatMethodDistanceSolver", "MeshVectorHeatSolver", "MinimalSurface", "Parameterization", "Path", "PointCloud",
    "PointCloudHeatSolver", "Segments", "SolverFailure", "Spectrum", "Surface", "Trace", "TuftedWarning", "compute_distance", "compute_distance_multisource", "denoise", "load",
    "mesh_laplacian", "point_cloud_laplacian", "read", "read_mesh", "read_point_cloud", "thin",
]
