// 01_laplacian FILE: builds the Laplacian of a PCD file and says what became of its points.
#include <pcl/io/pcd_io.h>
#include <tufted/pcl/laplacian_estimation.h>

#include <algorithm>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 01_laplacian FILE\n";
    return 2;
  }
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  if (pcl::io::loadPCDFile(argv[1], *cloud) != 0) return 1;

  // An organized cloud that a pinhole camera saw is recognised, and its pixels are used instead of a search tree.
  tufted::LaplacianEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  const auto surface = estimation.compute();  // after a mistake, which PCL's console names, it has no rows
  if (surface->M.size() == 0) return 1;

  // Row i of L and M is point i, also if the point is NaN or isolated. Its row is then empty, and status says why.
  const auto active = std::count(surface->status.begin(), surface->status.end(), tufted::PointStatus::active);
  std::cout << active << " of " << cloud->size() << " points take part\n"
            << "area " << surface->M.sum() << ", components " << surface->report.components << "\n"
            << "entries of L " << surface->L.nonZeros() << "\n";
}
