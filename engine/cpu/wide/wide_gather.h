/// Tiles, for the CPU that this file is compiled for; after wide_step.h and wide_blend.h. A superset of what the rays meet is gathered
/// in float32; each ray's own hits are decided by the tests of wide_step.h, so they have the bits of a walk of that ray alone.

namespace splatray {
namespace {

Lanes dot(const Vectors& a, const std::array<float, 3>& b) { return dot(a, vectors_of(b)); }

void sift_up(WideTile& tile, std::uint32_t place) {
  const WideBox box = tile.box[place];
  for (; place > 0; place = (place - 1) / 2) {
    const WideBox& parent = tile.box[(place - 1) / 2];
    if (parent.t <= box.t) break;
    tile.box[place] = parent;
  }
  tile.box[place] = box;
}

/// Takes the nearest box out.
WideBox nearest_box(WideTile& tile) {
  const WideBox nearest = tile.box[0], last = tile.box[--tile.boxes];
  std::uint32_t place = 0;
  for (std::uint32_t child = 1; child < tile.boxes; child = 2 * place + 1) {
    if (child + 1 < tile.boxes && tile.box[child + 1].t < tile.box[child].t) ++child;
    if (tile.box[child].t >= last.t) break;
    tile.box[place] = tile.box[child];
    place = child;
  }
  tile.box[place] = last;
  return nearest;
}

/// The greatest product of a plane with the points of boxes.
Lanes greatest(const WideNode& node, std::uint32_t from, const std::array<float, 3>& normal, float begin) {
  Lanes sum = of(begin);
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    sum =
        hn::MulAdd(of(normal[axis]), load_bounds(node.bounds[axis][normal[axis] > 0.0F ? 1 : 0], from), sum);
  return sum;
}

/// Puts the children of a node that rays of the tile may meet onto the heap.
void open_node(const WideView& tree, const WideBox& box, WideTile& tile) {
  const WideNode& node = tree.nodes[tree.levels.begin[box.level] + box.number];
  const std::array<float, 3> back{-tile.ahead[0], -tile.ahead[1], -tile.ahead[2]};
  const float middle_depth =
      tile.ahead[0] * tile.middle[0] + tile.ahead[1] * tile.middle[1] + tile.ahead[2] * tile.middle[2];
  alignas(64) WideFloats depth;
  std::uint32_t met = 0;
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    std::uint32_t there = (1U << LANES) - 1U;
    for (const std::array<float, 4>& plane : tile.planes)
      there &= bits_of(TAG, greatest(node, from, {plane[0], plane[1], plane[2]}, plane[3]) >= of(0.0F));
    hn::Store(hn::Neg(greatest(node, from, back, middle_depth + tile.slack)), TAG, depth.data() + from);
    met |= there << from;
  }
  met &= there_in(tree.levels, box.level, box.number);
  for (; met != 0; met &= met - 1) {
    if (tile.boxes == TILE_BOXES) {
      tile.full = true;
      return;
    }
    const auto child = static_cast<std::uint32_t>(__builtin_ctz(met));
    const WideBox next{depth[child], box.level - 1, box.number * WIDE + child};
    if (next.level == 0)
      for (std::size_t i = 0; i < 4; ++i)
        __builtin_prefetch(tree.splats + std::size_t{4} * WIDE * next.number + i * WIDE);
    tile.box[tile.boxes] = next;
    sift_up(tile, tile.boxes++);
  }
}

/// The first pixel along an axis of the picture that may see each splat, and the one behind the last.
struct alignas(64) Reach {
  WideWords first, last;
};

/// `across`: their places times the scale; `half`: half their sizes so; w lies in [w_low, w_high].
void reach_of(Lanes across, Lanes half, Lanes w_low, Lanes w_high, float first, float last,
              std::uint32_t pixels, std::uint32_t from, Reach& reach) {
  const Lanes low = across - half, high = across + half, zero = of(0.0F), pad = of(0.01F);
  const Lanes inverse_low = of(1.0F) / w_low, inverse_high = of(1.0F) / w_high;
  // What reaches behind the eye may be seen anywhere.
  const auto before = w_low > zero;
  const Lanes most = of(static_cast<float>(pixels - 1));
  const Lanes least_x = hn::Min(low * inverse_low, low * inverse_high) - pad;
  const Lanes most_x = hn::Max(high * inverse_low, high * inverse_high) + pad;
  const Lanes begin = hn::Min(hn::Max(hn::Ceil(least_x - of(last)), zero), most + of(1.0F));
  const Lanes end = hn::Min(hn::Max(hn::Floor(most_x - of(first)), of(-1.0F)), most);
  hn::Store(hn::BitCast(WORD_TAG, hn::ConvertTo(INT_TAG, hn::IfThenElseZero(before, begin))), WORD_TAG,
            &reach.first[from]);
  hn::Store(hn::BitCast(WORD_TAG, hn::ConvertTo(INT_TAG, hn::IfThenElse(before, end, most) + of(1.0F))),
            WORD_TAG, &reach.last[from]);
}

/// Adds a splat to a pixel's list.
void add_to_list(const WideDiscs& discs, std::uint32_t lane, std::uint32_t splat, float depth,
                 std::uint32_t slot, WideTile& tile) {
  const std::uint32_t place = tile.count[slot] % WIDE;
  if (place == 0) {
    if (tile.parts == TILE_PARTS) {
      tile.full = true;
      return;
    }
    const std::uint32_t part = tile.parts++;
    (tile.count[slot] == 0 ? tile.begin[slot] : tile.part[tile.end[slot]].next) = part;
    tile.end[slot] = part;
    tile.part[part].nearest = depth;
  }
  WidePart& part = tile.part[tile.end[slot]];
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    part.discs.center[axis][place] = discs.center[axis][lane];
    part.discs.normal[axis][place] = discs.normal[axis][lane];
  }
  part.discs.radius_squared[place] = discs.radius_squared[lane];
  part.splat[place] = splat;
  if (depth < part.nearest) part.nearest = depth;
  ++tile.count[slot];
}

/// Puts the splats of a leaf into the lists of the pixels that may see them.
void open_leaf(const WideView& tree, std::uint32_t number, WideTile& tile) {
  WideDiscs discs;
  const std::uint32_t there = decode_leaf(tree, number, discs);
  Reach columns, rows;
  alignas(64) WideFloats nearest;
  std::uint32_t seen = 0;
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    const Vectors place{load(discs.center[0], from) - of(tile.middle[0]),
                        load(discs.center[1], from) - of(tile.middle[1]),
                        load(discs.center[2], from) - of(tile.middle[2])};
    const Vectors stored{load(discs.normal[0], from), load(discs.normal[1], from),
                         load(discs.normal[2], from)};
    const Vectors normal = stored * inverse_sqrt(dot(stored, stored));
    const Lanes radius = hn::Sqrt(load(discs.radius_squared, from)), slack = of(tile.slack);
    // How far a disc reaches along a unit vector; of w_ahead, which may be zero, at most as much.
    const auto half = [&](const std::array<float, 3>& axis) {
      const Lanes cosine = dot(normal, axis);
      return radius * hn::Sqrt(hn::Max(of(1.0F) - cosine * cosine, of(0.0F))) + slack;
    };
    const Lanes half_ahead = half(tile.ahead), depth = dot(place, tile.ahead);
    const bool perspective = tile.w_ahead[0] != 0.0F || tile.w_ahead[1] != 0.0F || tile.w_ahead[2] != 0.0F;
    const Lanes w = dot(place, tile.w_ahead) + of(tile.w_begin), half_w = perspective ? half_ahead : of(0.0F);
    const Lanes w_low = w - half_w, w_high = w + half_w;
    const auto along = [&](const std::array<float, 3>& axis, std::uint32_t i, std::uint32_t pixels,
                           Reach& reach) {
      reach_of(dot(place, axis) * of(tile.scale[i]), half(axis) * of(tile.scale[i]), w_low, w_high,
               tile.first[i], tile.last[i], pixels, from, reach);
    };
    along(tile.right, 0, tile.width, columns);
    along(tile.down, 1, tile.height, rows);
    hn::Store(depth - half_ahead, TAG, &nearest[from]);
    const auto filled = [&](const Reach& reach) {
      return hn::RebindMask(TAG,
                            hn::Load(WORD_TAG, &reach.first[from]) < hn::Load(WORD_TAG, &reach.last[from]));
    };
    const auto met = hn::And(hn::And(filled(columns), filled(rows)), w_high > of(0.0F));
    seen |= bits_of(TAG, met) << from;
  }
  seen &= there;
  for (; seen != 0; seen &= seen - 1) {
    const auto lane = static_cast<std::uint32_t>(__builtin_ctz(seen));
    for (std::uint32_t y = rows.first[lane]; y < rows.last[lane]; ++y)
      for (std::uint32_t x = columns.first[lane]; x < columns.last[lane]; ++x)
        add_to_list(discs, lane, number * WIDE + lane, nearest[lane], y * tile.width + x, tile);
  }
}

void open_tile(const WideView& tree, WideTile& tile) {
  tile.full = false;
  tile.parts = tile.boxes = 0;
  for (std::uint32_t& count : tile.count) count = 0;
  if (tree.levels.levels == 0) return;
  tile.box[0] = {-3e38F, tree.levels.levels, 0};
  tile.boxes = 1;
}

std::uint32_t step_tile(const WideView& tree, WideTile& tile, WideCursor& cursor, WideWalk& walk) {
  while (!tile.full) {
    while (cursor.seen < tile.count[cursor.slot]) {
      const std::uint32_t place = cursor.seen % WIDE;
      if (place == 0) cursor.part = cursor.seen == 0 ? tile.begin[cursor.slot] : tile.part[cursor.part].next;
      const std::uint32_t left = tile.count[cursor.slot] - cursor.seen, room = WIDE - place;
      const std::uint32_t tested = left < room ? left : room;
      const WidePart& part = tile.part[cursor.part];
      cursor.seen += tested;
      if (part.nearest > cursor.begin + cursor.per_t * walk.t_max + tile.slack) continue;
      const std::uint32_t new_ones = ((1U << tested) - 1U) << place;
      // For few splats the exact test alone costs less.
      std::uint32_t met = new_ones;
      if (tested > DOUBLE_LANES) met &= maybe_hits(part.discs, walk);
      if (met != 0) met = meet_splats(part.discs, met, walk);
      if (met != 0) return met;
    }
    if (tile.boxes == 0 || tile.box[0].t > cursor.begin + cursor.per_t * walk.t_max + tile.slack) return 0;
    const WideBox box = nearest_box(tile);
    if (box.level == 0)
      open_leaf(tree, box.number, tile);
    else
      open_node(tree, box, tile);
  }
  return 0;
}

}  // namespace
}  // namespace splatray
