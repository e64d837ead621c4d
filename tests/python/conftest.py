"""A cloud and a mesh that many tests look at; none of them changes."""
import pytest

import tufted
from support import CLOUD, torus_mesh


@pytest.fixture(scope="module")
def cloud():
    return tufted.PointCloud(CLOUD)


@pytest.fixture(scope="module")
def mesh():
    return tufted.Mesh(*torus_mesh(60, 30))
