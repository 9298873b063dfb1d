/// @file Paths of the form package://name/path, without a ROS library.
#pragma once

#include <functional>
#include <string>

namespace ppf_bin_picking
{
/// The folder of a ROS package; empty if there is none of that name.
using PackageFinder = std::function<std::string(const std::string& package)>;

/// A finder that searches each folder of ROS_PACKAGE_PATH as rospack does: all folders below it,
/// but none below a package or below a file CATKIN_IGNORE or rospack_nosubdirs, and no hidden one.
/// The nearest to the top is taken. At most 100000 folders are looked at.
std::string findPackage(const std::string& package);

/// True for package://...
bool isPackagePath(const std::string& path);

/// The path in the file system of package://name/path.
/// @param where  What gives the path; begins the message.
/// @throw InputError if the package is not found.
std::string resolvedPackagePath(const std::string& path, const std::string& where,
                                const PackageFinder& finder = findPackage);
}  // namespace ppf_bin_picking
