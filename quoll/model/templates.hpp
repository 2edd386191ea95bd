#pragma once
// Small complete worlds to copy and change: what `quoll new template`, `quoll new csv-template` and
// `quoll new world NAME` give.

#include <string>
#include <string_view>

namespace quoll {

/// A maintenance problem as a TOML world, every element of the format explained once.
std::string_view toml_template();

/// The same problem, number by number, as a CSV world.
std::string_view csv_template();

/// A C++ program with a world of one's own as a plain struct, learned and shown. `name`: letters,
/// digits and '-', beginning with a letter ("my-world" gives the struct MyWorld).
std::string world_template(std::string_view name);

}  // namespace quoll
