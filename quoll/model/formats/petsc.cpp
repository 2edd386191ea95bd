// Sparse matrices as PETSc's MatView writes them in binary (petsc.org, "MatLoad", section "Notes
// for advanced users"), big-endian: the number 1211216, rows, columns, entries; the entries of each
// row; their columns; their values. All whole numbers have 32 or all have 64 bits, after how PETSc
// was built. A dense matrix has -1 entries and then the values row by row.
//
// For S states and A actions the transitions have S*A rows, those of a state next to each other,
// and S columns; the rewards have S rows and A columns (madupite keeps its models like this).

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "quoll/base/bytes.hpp"
#include "quoll/base/file.hpp"
#include "quoll/base/text.hpp"
#include "quoll/model/formats/format.hpp"

namespace quoll {
namespace {

constexpr std::uint64_t magic = 1211216;
constexpr std::uint64_t most_entries = std::uint64_t{1} << 58;  // so that no size overflows

/// Where the parts of a matrix lie in its bytes.
class Matrix {
 public:
  static Result<Matrix> open(std::string_view bytes, const std::string& path);

  std::uint64_t rows = 0, columns = 0, entries = 0;
  bool dense = false;

  /// Entries of a row of a sparse matrix.
  std::uint64_t length(std::uint64_t row) const { return whole(head_ + row * width_); }
  std::uint64_t column(std::uint64_t entry) const { return whole(columns_at_ + entry * width_); }
  double value(std::uint64_t entry) const {
    return std::bit_cast<double>(load_big<std::uint64_t>(bytes_.data() + values_at_ + entry * 8));
  }

 private:
  std::uint64_t whole(std::uint64_t at) const {
    return width_ == 8 ? load_big<std::uint64_t>(bytes_.data() + at)
                       : load_big<std::uint32_t>(bytes_.data() + at);
  }

  std::string_view bytes_;
  std::uint64_t width_ = 4;
  std::uint64_t head_ = 0, columns_at_ = 0, values_at_ = 0;
};

Error refused(const std::string& path, std::string expected) {
  return Error{path, 0, 0, std::move(expected), ""};
}

Result<Matrix> Matrix::open(std::string_view bytes, const std::string& path) {
  Matrix m;
  m.bytes_ = bytes;
  if (bytes.size() >= 16 && load_big<std::uint32_t>(bytes.data()) == magic) {
    m.width_ = 4;
  } else if (bytes.size() >= 32 && load_big<std::uint64_t>(bytes.data()) == magic) {
    m.width_ = 8;
  } else {
    return refused(path, "expected a matrix in PETSc's binary format, which begins with 1211216");
  }
  m.head_ = 4 * m.width_;
  m.rows = m.whole(m.width_);
  m.columns = m.whole(2 * m.width_);
  m.entries = m.whole(3 * m.width_);
  const std::uint64_t none = m.width_ == 4 ? std::numeric_limits<std::uint32_t>::max()
                                           : std::numeric_limits<std::uint64_t>::max();
  m.dense = m.entries == none;
  const std::string size = std::to_string(m.rows) + " x " + std::to_string(m.columns);
  const std::uint64_t rest = bytes.size() - m.head_;
  if (m.dense) {
    const bool fits = m.rows <= rest / 8 && (m.columns == 0 || m.rows <= rest / 8 / m.columns);
    m.entries = fits ? m.rows * m.columns : most_entries;
    m.values_at_ = m.head_;
    if (fits && rest == m.entries * 8) return m;
    return refused(path, "expected the values of a matrix of " + size + " behind its head, found " +
                             std::to_string(rest) + " bytes");
  }
  const bool possible = m.rows < most_entries && m.entries < most_entries;
  if (!possible || rest != m.rows * m.width_ + m.entries * (m.width_ + 8)) {
    return refused(path, "expected " + std::to_string(m.entries) + " entries in a matrix of " +
                             size + ", found " + std::to_string(rest) + " bytes behind its head");
  }
  m.columns_at_ = m.head_ + m.rows * m.width_;
  m.values_at_ = m.columns_at_ + m.entries * m.width_;
  std::uint64_t sum = 0;
  for (std::uint64_t row = 0; row < m.rows; ++row) {
    if (m.length(row) > m.entries - sum) {
      return refused(path, "row " + std::to_string(row) + ": more entries than the matrix has");
    }
    sum += m.length(row);
  }
  if (sum == m.entries) return m;
  return refused(path, "expected rows of " + std::to_string(m.entries) +
                           " entries together, found " + std::to_string(sum));
}

struct PetscSettings {
  std::string rewards;
  double discount = 0.99;
  bool costs = false;

  void describe(Describer& d) {
    d("rewards", rewards, "file with the matrix of rewards, states x actions; empty = all 0");
    d("discount", discount, std::numeric_limits<double>::denorm_min(), 1.0,
      "discount of the model");
    d("costs", costs, "the rewards are costs: their signs are turned");
  }
};

// The entries of a row in the order of the file; zeros of a dense matrix count as none.
template <class Visit>
bool for_each_in_row(const Matrix& m, std::uint64_t row, std::uint64_t& entry, Visit visit) {
  const std::uint64_t end = entry + (m.dense ? m.columns : m.length(row));
  for (std::uint64_t first = entry; entry < end; ++entry) {
    const std::uint64_t column = m.dense ? entry - first : m.column(entry);
    if (column >= m.columns) return false;
    const double value = m.value(entry);
    if (!m.dense || value != 0.0) visit(column, value);
  }
  return true;
}

Error bad_column(const std::string& path, std::uint64_t row, const Matrix& m) {
  return refused(path, "row " + std::to_string(row) + ": columns below " +
                           std::to_string(m.columns) + " expected");
}

Result<void> read_rewards(const PetscSettings& settings, std::uint64_t states,
                          std::uint64_t actions, MdpArrays& arrays) {
  const Result<std::string> content = read_file(settings.rewards);
  if (!content) return refused(settings.rewards, content.error().expected);
  const Result<Matrix> m = Matrix::open(*content, settings.rewards);
  if (!m) return m.error();
  if (m->rows != states || m->columns != actions) {
    return refused(settings.rewards, "expected a matrix of " + std::to_string(states) + " x " +
                                         std::to_string(actions) + ", states x actions, found " +
                                         std::to_string(m->rows) + " x " +
                                         std::to_string(m->columns));
  }
  std::uint64_t entry = 0;
  for (std::uint64_t s = 0; s < states; ++s) {
    const bool fits = for_each_in_row(*m, s, entry, [&](std::uint64_t action, double value) {
      arrays.reward[s * actions + action] += settings.costs ? -value : value;
    });
    if (!fits) return bad_column(settings.rewards, s, *m);
  }
  return {};
}

}  // namespace

Result<MdpArrays> read_petsc(std::string_view content, const std::string& path,
                             const Parameters& given) {
  const Result<PetscSettings> settings = read_parameters<PetscSettings>(path, given);
  if (!settings) return settings.error();
  const Result<Matrix> m = Matrix::open(content, path);
  if (!m) return m.error();
  const std::uint64_t states = m->columns;
  if (states == 0 || states > max_states || m->rows == 0 || m->rows % states != 0) {
    return refused(path, "expected states * actions rows and a column per state, found " +
                             std::to_string(m->rows) + " x " + std::to_string(states));
  }
  const std::uint64_t actions = m->rows / states;
  MdpArrays arrays;
  arrays.discount = settings->discount;
  std::uint64_t entry = 0;
  arrays.outcome_begin.push_back(0);
  for (std::uint64_t row = 0; row < m->rows; ++row) {
    const bool fits = for_each_in_row(*m, row, entry, [&](std::uint64_t next, double value) {
      arrays.next.push_back(static_cast<State>(next));
      arrays.probability.push_back(value);
    });
    if (!fits) return bad_column(path, row, *m);
    arrays.outcome_begin.push_back(arrays.next.size());
    arrays.action.push_back(static_cast<std::uint32_t>(row % actions));
  }
  for (std::uint64_t s = 0; s <= states; ++s) arrays.choice_begin.push_back(s * actions);
  arrays.state_names = Names::numbered("", states);
  arrays.action_names = Names::numbered("", actions);
  arrays.reward.assign(m->rows, 0.0);
  if (!settings->rewards.empty()) {
    const Result<void> done = read_rewards(*settings, states, actions, arrays);
    if (!done) return done.error();
  }
  return arrays;
}

std::vector<ParameterText> petsc_parameters() {
  return parameters_of<PetscSettings>();
}

}  // namespace quoll
