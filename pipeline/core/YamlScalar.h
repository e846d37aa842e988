// The words of YAML: what a scalar means, and what a syntax error means in our words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/Document.h"
#include "core/TextPlaces.h"

namespace crevice {

/// A scalar without quotes by the core schema of YAML 1.2 (section 10.3.2): true, false, null, numbers, else a string.
Value readPlainYamlScalar(const std::string& text, const SourceLoc& where);
/// A scalar in quotes (tag "!") or with an explicit tag, of which only `!!str` is known.
Value readTaggedYamlScalar(const std::string& tag, const std::string& text, const SourceLoc& where);

/// `reason` comes from the parser and only chooses between our own texts.
Problem explainYamlSyntax(std::string_view text, const TextPlaces& places, std::size_t offset, std::string_view reason);

}  // namespace crevice
