// What pictures show where shadow volumes are counted in some way. Repeated predictions for the
// same few patches are quick, because the volumes' faces along their rays stay the same.
#pragma once

#include "compare/picture/predict.h"
#include "scenes/counter.h"
#include "scenes/depth_model.h"

#include <memory>

namespace shadowproof {

class VolumeCounts {
public:
    /// Keeps a reference.
    explicit VolumeCounts(const TracedScene& traced);
    ~VolumeCounts();
    VolumeCounts(const VolumeCounts&) = delete;
    VolumeCounts& operator=(const VolumeCounts&) = delete;

    /// Lit where the counter is zero. Surfaces before the model's near plane are not seen. `far`:
    /// view depth of the far plane, where the model has one. Refers to this; one prediction at a
    /// time.
    Predict predict(const Counting& counting, const DepthModel& model, double far) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shadowproof
