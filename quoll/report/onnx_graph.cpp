#include "quoll/report/onnx_graph.hpp"

#include <bit>

#include "quoll/report/protobuf.hpp"

namespace quoll {
namespace {

using protobuf::add_bytes;
using protobuf::add_number;

constexpr std::uint64_t format_version = 7, operator_set = 13;

// ValueInfoProto: name = 1, type = 2; TypeProto: tensor_type = 1; Tensor: elem_type = 1, shape = 2;
// TensorShapeProto: dim = 1; Dimension: dim_value = 1, dim_param = 2.
std::string value_info(std::string_view name, OnnxGraph::Element element,
                       const OnnxGraph::Shape& shape) {
  std::string dimensions;
  for (const std::int64_t size : shape) {
    std::string dimension;
    if (size < 0)
      add_bytes(dimension, 2, "batch");
    else
      add_number(dimension, 1, static_cast<std::uint64_t>(size));
    add_bytes(dimensions, 1, dimension);
  }
  std::string tensor, type, out;
  add_number(tensor, 1, static_cast<std::uint64_t>(element));
  add_bytes(tensor, 2, dimensions);
  add_bytes(type, 1, tensor);
  add_bytes(out, 1, name);
  add_bytes(out, 2, type);
  return out;
}

// TensorProto: dims = 1, data_type = 2, name = 8, raw_data = 9, least significant byte first.
std::string tensor(std::string_view name, OnnxGraph::Element element, const OnnxGraph::Shape& shape,
                   std::string_view data) {
  std::string out;
  for (const std::int64_t size : shape) add_number(out, 1, static_cast<std::uint64_t>(size));
  add_number(out, 2, static_cast<std::uint64_t>(element));
  add_bytes(out, 8, name);
  add_bytes(out, 9, data);
  return out;
}

// AttributeProto: name = 1, i = 3, ints = 8, type = 20 (INT = 2, INTS = 7).
std::string attribute(const OnnxGraph::Attribute& what) {
  std::string out;
  add_bytes(out, 1, what.name);
  for (const std::int64_t number : what.numbers) {
    add_number(out, what.list ? 8 : 3, static_cast<std::uint64_t>(number));
  }
  add_number(out, 20, what.list ? 7 : 2);
  return out;
}

}  // namespace

// GraphProto: node = 1, name = 2, initializer = 5, input = 11, output = 12.
void OnnxGraph::input(std::string_view name, Element element, const Shape& shape) {
  add_bytes(inputs_, 11, value_info(name, element, shape));
}

void OnnxGraph::output(std::string_view name, Element element, const Shape& shape) {
  add_bytes(outputs_, 12, value_info(name, element, shape));
}

std::string OnnxGraph::constant(std::string_view name, const Shape& shape,
                                std::span<const float> numbers) {
  std::string data;
  for (const float x : numbers) append_little(data, std::bit_cast<std::uint32_t>(x));
  add_bytes(constants_, 5, tensor(name, Element::real, shape, data));
  return std::string(name);
}

std::string OnnxGraph::constant(std::string_view name, const Shape& shape,
                                std::span<const std::int64_t> numbers) {
  std::string data;
  for (const std::int64_t x : numbers) append_little(data, static_cast<std::uint64_t>(x));
  add_bytes(constants_, 5, tensor(name, Element::whole, shape, data));
  return std::string(name);
}

// NodeProto: input = 1, output = 2, name = 3, op_type = 4, attribute = 5.
std::string OnnxGraph::node(std::string_view what, const std::vector<std::string>& reads,
                            const std::vector<Attribute>& attributes, std::string_view name) {
  std::string out = name.empty() ? "v" + std::to_string(++named_) : std::string(name);
  std::string message;
  for (const std::string& read : reads) add_bytes(message, 1, read);
  add_bytes(message, 2, out);
  add_bytes(message, 3, "make " + out);
  add_bytes(message, 4, what);
  for (const Attribute& one : attributes) add_bytes(message, 5, attribute(one));
  add_bytes(nodes_, 1, message);
  return out;
}

// ModelProto: ir_version = 1, producer_name = 2, graph = 7, opset_import = 8 (version = 2),
// metadata_props = 14 (key = 1, value = 2).
std::string OnnxGraph::model(std::string_view name,
                             std::span<const std::pair<std::string, std::string>> facts) const {
  std::string graph = nodes_, operators, out;
  add_bytes(graph, 2, name);
  graph += constants_ + inputs_ + outputs_;
  add_number(operators, 2, operator_set);
  add_number(out, 1, format_version);
  add_bytes(out, 2, "quoll");
  add_bytes(out, 7, graph);
  add_bytes(out, 8, operators);
  for (const auto& [key, text] : facts) {
    std::string fact;
    add_bytes(fact, 1, key);
    add_bytes(fact, 2, text);
    add_bytes(out, 14, fact);
  }
  return out;
}

}  // namespace quoll
