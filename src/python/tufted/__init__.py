"""Laplacians of point clouds and triangle meshes, and algorithms on them.

PointCloud, Mesh and read build L and M, and have all algorithms as methods. point_cloud_laplacian, mesh_laplacian,
PointCloudHeatSolver and the mesh solvers have the names and arguments of robust_laplacian and potpourri3d.

L is minus the Laplacian, integrated: symmetric, positive semidefinite. M holds areas. Poisson equation: L u = M f.
Eigenproblem: L x = lambda M x.
"""
from ._clouds import Mesh, PointCloud, denoise, load, read, thin
from ._drop_in import (MeshHeatMethodDistanceSolver, MeshVectorHeatSolver, PointCloudHeatSolver, PolygonMeshHeatSolver,
                       compute_distance, compute_distance_multisource, mesh_laplacian, point_cloud_laplacian)
from ._drop_in_curves import (EdgeFlipGeodesicSolver, GeodesicTracer, MeshFastMarchingDistanceSolver,
                              MeshMarchingTrianglesSolver, MeshSignedHeatSolver, PointCloudLocalTriangulation,
                              marching_triangles)
from ._drop_in_files import (cotan_laplacian, edges, face_areas, read_mesh, read_point_cloud, read_polygon_mesh,
                             vertex_areas, write_mesh, write_point_cloud)
from ._maps import functional_map, point_maps, zoom_out
from ._results import (Curvature, Deformation, Denoised, Gradients, Isoline, LogMap, MinimalSurface, Page,
                       Parameterization, Path, Picture, PointMaps, Segments, Signature, Spectrum, Trace)
from ._surface import Surface, TuftedWarning
from ._tiles import laplacian_by_tiles
from ._tufted import Cancelled, FileTooLarge, InvalidInput, IoError, SolverFailure
from ._tufted import version as __version__

__all__ = [
    "Cancelled", "Curvature", "Deformation", "Denoised", "EdgeFlipGeodesicSolver", "FileTooLarge", "GeodesicTracer",
    "Gradients", "InvalidInput", "IoError", "Isoline", "LogMap", "Mesh", "MeshFastMarchingDistanceSolver",
    "MeshHeatMethodDistanceSolver", "MeshMarchingTrianglesSolver", "MeshSignedHeatSolver", "MeshVectorHeatSolver",
    "MinimalSurface", "Page", "Parameterization", "Path", "Picture", "PointCloud", "PointCloudHeatSolver",
    "PointCloudLocalTriangulation", "PointMaps", "PolygonMeshHeatSolver", "Segments", "Signature", "SolverFailure",
    "Spectrum", "Surface", "Trace", "TuftedWarning", "compute_distance", "compute_distance_multisource",
    "cotan_laplacian", "denoise", "edges", "face_areas", "functional_map", "laplacian_by_tiles", "load",
    "marching_triangles", "mesh_laplacian", "point_cloud_laplacian", "point_maps", "read", "read_mesh",
    "read_point_cloud", "read_polygon_mesh", "thin", "vertex_areas", "write_mesh", "write_point_cloud", "zoom_out",
]
