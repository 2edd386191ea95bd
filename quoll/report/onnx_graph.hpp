#pragma once
// A graph of operators as it grows, written as an ONNX model (github.com/onnx/onnx, onnx.proto,
// version 1.8: operator set 13). Every value has a name; a node is added after what it reads.

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quoll {

class OnnxGraph {
 public:
  enum class Element : std::uint8_t { real = 1, whole = 7 };  ///< float, int64
  using Shape = std::vector<std::int64_t>;                    ///< -1 = the batch
  /// A whole number, or a list of them.
  struct Attribute {
    std::string_view name;
    std::vector<std::int64_t> numbers;
    bool list = true;
  };

  void input(std::string_view name, Element element, const Shape& shape);
  void output(std::string_view name, Element element, const Shape& shape);
  /// A constant; returns `name`.
  std::string constant(std::string_view name, const Shape& shape, std::span<const float> numbers);
  std::string constant(std::string_view name, const Shape& shape,
                       std::span<const std::int64_t> numbers);
  /// Adds a node of one output; returns its name: `name`, or one of its own.
  std::string node(std::string_view what, const std::vector<std::string>& reads,
                   const std::vector<Attribute>& attributes = {}, std::string_view name = {});

  /// The model. `facts` = its metadata.
  std::string model(std::string_view name,
                    std::span<const std::pair<std::string, std::string>> facts) const;

 private:
  std::string inputs_, outputs_, constants_, nodes_;  // fields of the graph
  std::size_t named_ = 0;
};

}  // namespace quoll
