// 07_ros_node: a node of ROS 1. For each sensor_msgs/PointCloud2 on `points` it publishes the points with normals,
// which face the sensor, as another one on `normals`: fields x, y, z, normal_x, normal_y, normal_z, in the frame and of
// the time of the input. A point that takes no part has normals of NaN.
#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <tufted/pcl/laplacian_estimation.h>
#include <tufted/pcl/oriented_normal_estimation.h>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

class NormalNode {
 public:
  NormalNode() {
    // Without curvature, which takes longer than the rest. The classes are members, as they keep memory between frames.
    normal_estimation_.setComputeCurvature(false);
    publisher_ = handle_.advertise<sensor_msgs::PointCloud2>("normals", 1);
    // A queue of one message: a frame that comes while another is computed replaces the one that waits.
    subscriber_ = handle_.subscribe("points", 1, &NormalNode::onPoints, this);
  }

 private:
  void onPoints(const sensor_msgs::PointCloud2ConstPtr& message) {
    const ros::WallTime start = ros::WallTime::now();
    const Cloud::Ptr cloud(new Cloud);
    pcl::fromROSMsg(*message, *cloud);
    estimation_.setInputCloud(cloud);
    const auto surface = estimation_.compute();  // after a mistake, which PCL's console names, it has no rows
    if (surface->M.size() == 0) return;
    normal_estimation_.setInputCloud(cloud);
    normal_estimation_.setSurface(surface);
    pcl::PointCloud<pcl::PointNormal> normals;
    normal_estimation_.compute(normals);

    sensor_msgs::PointCloud2 result;
    pcl::toROSMsg(normals, result);
    result.header = message->header;  // PCL's times have whole microseconds only
    publisher_.publish(result);
    ROS_INFO("%u x %u points, area %g, %.0f ms", cloud->width, cloud->height, surface->M.sum(),
             1000 * (ros::WallTime::now() - start).toSec());
  }

  ros::NodeHandle handle_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  tufted::LaplacianEstimation<pcl::PointXYZ> estimation_;
  tufted::OrientedNormalEstimation<pcl::PointXYZ, pcl::PointNormal> normal_estimation_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "tufted_normals");
  NormalNode node;
  ros::spin();
}
