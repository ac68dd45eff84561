// Explains a pixel's counter: what each face on its ray did to it.
#pragma once

#include "compare/judge/account.h"
#include "compare/judge/pixel_record.h"
#include "reference/predict/prediction.h"

namespace shadowproof {

/// `prediction`: of how the frame counts. The account's lengths are the record's times `unit`.
Account account_of_counter(const Frame& frame, const Prediction& prediction,
                           const PixelRecord& record, double unit);

} // namespace shadowproof
