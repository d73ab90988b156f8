#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "head/files/camera_entries.hpp"

namespace priamos::head {

/// The values of a camera's file by their keys, with the sentences for those that are not as they should be.
class CameraValues {
 public:
  CameraValues(std::string file, CameraEntries entries)
      : file_(std::move(file)), entries_(std::move(entries)) {}

  /// The entry of the first of `keys` that is there, below `below` ("cameras/0", "" for the root); its
  /// numbers may be in a key "data" of their own, as those of matrices are. Null if none is there or holds a
  /// word.
  const CameraEntry* Find(const std::string& below, std::initializer_list<const char*> keys) const;
  bool Has(const std::string& below, std::initializer_list<const char*> keys) const {
    return Find(below, keys) != nullptr;
  }
  /// `count` finite numbers (0: any number of them). Throws ConfigError if they are not there.
  std::vector<double> Numbers(const std::string& below, std::initializer_list<const char*> keys,
                              std::size_t count) const;
  double Number(const std::string& below, std::initializer_list<const char*> keys) const {
    return Numbers(below, keys, 1).front();
  }
  /// A square matrix or a part of one, row by row.
  Eigen::Matrix3d Matrix(const std::string& below, std::initializer_list<const char*> keys) const;
  Eigen::Matrix<double, 3, 4> Projection(const std::string& below,
                                         std::initializer_list<const char*> keys) const;

  /// Throws ConfigError "FILE:LINE: KEY: what".
  [[noreturn]] void Fail(const CameraEntry& at, const std::string& what) const;
  /// Throws ConfigError "FILE: what".
  [[noreturn]] void Fail(const std::string& what) const;

 private:
  std::string file_;
  CameraEntries entries_;
};

}  // namespace priamos::head
