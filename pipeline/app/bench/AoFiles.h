// The benchmark's results as files: CSV and JSON for machines, HTML and Markdown for readers.
#pragma once

#include <string>

#include "app/bench/AoResults.h"
#include "core/Files.h"

namespace crevice {

/// A line per map; unknown values are empty.
std::string aoCsv(const AoResults& results);

/// Rows, tables, calibration, split and curves.
std::string aoJson(const AoResults& results);

/// One page with everything in it: pictures, script and plotting library. Throws Error when its parts are not found.
std::string aoPage(const AoResults& results, const AssetRoots& roots);

/// Tables between two marks; `text` is the file so far: what stands outside the marks stays. Throws Error when it has
/// text but no marks.
std::string aoMarkdown(const AoResults& results, const std::string& text);

}  // namespace crevice
