// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/map/map_reader.h"
#include "external_command/routing/router.h"

namespace external_command {

/// What a router is made of.
struct RouterSource {
  std::string map_file;
  MapOrigin origin;
  MapParams map;
  RouterParams router;
};

/// A file beside others in a folder, in which a large map is kept as it was resolved, with the index of its routes: of
/// that a router is made several times faster than of the map file. One file for each map file; where it was made of
/// other bytes or with other parameters, by another program or on another kind of machine, or where any bit of it has
/// changed since, it is not used, and written anew. Who may write into the folder decides what the map is.
class RouterCache {
 public:
  /// Smaller maps are resolved in no time.
  static constexpr std::uintmax_t kLeastMapSize = 8 << 20;  // [bytes]

  static constexpr std::chrono::hours kUnused{30 * 24};

  /// @param folder  is made when the first file is written.
  RouterCache(const std::string& folder, RouterSource source);

  /// Whether the map file is large enough, and its findings are not asked for.
  bool isWorthwhile() const;

  /// NAME-DIGEST.cache, by the map's name and the digest of its absolute path.
  const std::string& path() const { return path_; }

  struct Answer {
    std::shared_ptr<const Router> router;  ///< nullptr where the file cannot be used
    std::string why_not;                   ///< the reason; empty where there is no file
    bool is_damaged = false;               ///< or cannot be read, rather than outdated
  };

  /// The router as it was kept. Throws nothing but std::bad_alloc. Takes both files to read, and all processors.
  Answer read() const;

  /// Keeps a router that was made of the map file, in place of what was kept before, and removes what killed processes
  /// have left. The disk has confirmed it on return. Several processes may do so at once: each writes all of it.
  /// @throws InternalError  it cannot be written, or the disk would have less left than the size of the map file; what
  ///                        was kept before is still there.
  /// @throws Cancelled      it is looked at every few megabytes.
  void write(const Router& router, const CancelToken& cancel) const;

  /// Removes what was kept in the folder of other map files, and was not read or written for kUnused: who gives each
  /// version of a map another name would fill the disk.
  /// @return  the paths.
  std::vector<std::string> removeUnused() const;

 private:
  std::shared_ptr<const Router> routerOfFile() const;

  const std::string folder_;
  const RouterSource source_;
  const std::string name_, path_;
};

}  // namespace external_command
