#include "ppf_bin_picking/io/package_path.hpp"

#include "ppf_bin_picking/io/file_bytes.hpp"
#include "ppf_bin_picking/io/input_error.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <set>
#include <sstream>

namespace ppf_bin_picking
{
namespace fs = std::filesystem;
namespace
{
constexpr char kScheme[] = "package://";
constexpr std::size_t kMaxManifestBytes = 1 << 20;
constexpr std::size_t kMaxFolders = 100000;

bool holds(const fs::path& folder, const char* file)
{
  std::error_code error;
  return fs::exists(folder / file, error);
}

/// @param folder  One with a package.xml.
bool isNamed(const fs::path& folder, const std::string& package)
{
  try
  {
    const std::string manifest = readFile((folder / "package.xml").string(), kMaxManifestBytes);
    return manifest.find("<name>" + package + "</name>") != std::string::npos;
  }
  catch (const InputError&)
  {
    return false;
  }
}

/// The folders in a folder, sorted, so that the same package is found each time.
std::set<fs::path> subfolders(const fs::path& folder)
{
  std::set<fs::path> found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
  {
    std::error_code not_there;
    const bool hidden = entry->path().filename().string().front() == '.';
    if (!hidden && entry->is_directory(not_there)) found.insert(entry->path());
  }
  return found;
}

/// Level by level. Links are followed, each folder once.
fs::path findBelow(const fs::path& root, const std::string& package)
{
  std::deque<fs::path> waiting = {root};
  std::set<fs::path> seen;
  for (; !waiting.empty() && seen.size() < kMaxFolders; waiting.pop_front())
  {
    const fs::path& folder = waiting.front();
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (error || !seen.insert(real).second || holds(folder, "CATKIN_IGNORE")) continue;
    if (holds(folder, "package.xml"))
    {
      if (isNamed(folder, package)) return folder;
      continue;
    }
    if (holds(folder, "rospack_nosubdirs")) continue;
    const std::set<fs::path> below = subfolders(folder);
    waiting.insert(waiting.end(), below.begin(), below.end());
  }
  return {};
}
}  // namespace

std::string findPackage(const std::string& package)
{
  const char* roots = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream list(roots == nullptr ? "" : roots);
  for (std::string root; std::getline(list, root, ':');)
  {
    const fs::path folder = root.empty() ? fs::path() : findBelow(root, package);
    if (!folder.empty()) return folder.string();
  }
  return {};
}

bool isPackagePath(const std::string& path)
{
  return path.rfind(kScheme, 0) == 0;
}

std::string resolvedPackagePath(const std::string& path, const std::string& where,
                                const PackageFinder& finder)
{
  const std::size_t begin = std::string(kScheme).size();
  const std::size_t slash = std::min(path.find('/', begin), path.size());
  const std::string package = path.substr(begin, slash - begin);
  const std::string folder = finder(package);
  if (folder.empty())
    throw InputError(where + " names the package '" + package +
                     "', which is not found: source the workspace that holds it, or give an "
                     "absolute path");
  return folder + path.substr(slash);
}
}  // namespace ppf_bin_picking
