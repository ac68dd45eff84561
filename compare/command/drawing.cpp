#include "compare/command/drawing.h"

#include "compare/report/report_template.h"
#include "scenes/error.h"

#include <duktape.h>

#include <memory>
#include <new>

namespace shadowproof {

namespace {

struct DestroyHeap {
    void operator()(duk_context* context) const { duk_destroy_heap(context); }
};

void check(duk_context* context, duk_int_t failed) {
    if (failed != 0)
        throw Error("cutaway/cutaway.js", duk_safe_to_string(context, -1),
                    "report this with the scene and the pixel");
}

} // namespace

std::string draw_cutaway(const std::string& record, std::size_t technique) {
    const std::unique_ptr<duk_context, DestroyHeap> heap(duk_create_heap_default());
    if (!heap) throw std::bad_alloc();
    duk_context* context = heap.get();
    for (const char* name : {"cutaway/geometry.js", "cutaway/words.js", "cutaway/svg.js",
                             "cutaway/side.js", "cutaway/strip.js", "cutaway/comparison.js",
                             "cutaway/float_ray.js", "cutaway/evidence.js", "cutaway/cutaway.js"}) {
        const std::string_view script = viewer_file(name);
        check(context, duk_peval_lstring(context, script.data(), script.size()));
        duk_pop(context);
    }
    check(context, duk_peval_string(
                       context, "(function (text, k) { return cutaway(JSON.parse(text), k); })"));
    duk_push_lstring(context, record.data(), record.size());
    duk_push_number(context, static_cast<double>(technique));
    check(context, duk_pcall(context, 2));
    std::size_t length = 0;
    const char* svg = duk_require_lstring(context, -1, &length);
    return {svg, length};
}

} // namespace shadowproof
