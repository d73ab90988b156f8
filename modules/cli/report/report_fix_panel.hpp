#pragma once

#include "cli/report/report_record.hpp"
#include "common/drawing/drawing.hpp"

namespace priamos::cli {

/// Draws into `window`: believed minus true position just before and after every fix that corrected the pose,
/// with the ellipse of 2 sigma that the belief then claims; rings in centimetres around no error. The scale
/// is that of the largest error.
void DrawFixErrors(drawing::Drawing& page, const drawing::Box& window, const RunRecord& record);

}  // namespace priamos::cli
