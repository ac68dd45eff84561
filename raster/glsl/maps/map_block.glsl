// Averages over a block of texels. A shader that includes this defines before:
//   float stored_at(ivec2 texel)   what the map holds there; the texel may lie beside it

layout(location = 21) uniform int side; // texels a side of the block
layout(location = 22) uniform bool averages_values;

// The claim of a point at a place in the map, in texels, with its depth from the light's camera.
// Either each texel is compared, and the claim is the share of them that says lit
// (percentage-closer filtering); or their mean is compared once.
float claim_of_block(vec2 place, float depth) {
    ivec2 first = ivec2(floor(place - 0.5 * float(side - 1)));
    int lit = 0;
    float sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float stored = stored_at(first + ivec2(x, y));
            sum += stored;
            if (!is_shadowed(stored, depth)) ++lit;
        }
    int all = side * side;
    if (averages_values) lit = is_shadowed(sum / all, depth) ? 0 : all;
    if (lit == 0) discard;
    // The bytes between shadowed and lit are free for shares: see map_shadows.cpp.
    return lit < all ? float(64 + lit) / 255 : 1;
}
