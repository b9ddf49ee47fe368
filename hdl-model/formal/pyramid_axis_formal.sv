// A jump's bound covers every node that a sample of the jump is made of (equation 21), for every level,
// map and place, one axis. The box of a bound is the product of its axes.
//
// A jump of level m covers at most 2^m cells: J = 2^(m+k) steps of at most 2^-k cells. So every sample
// of it is at `place` + `offset` with |offset| <= 2^m cells, and the offset is free here: this holds for
// jumps of any length. To show, for a map of n nodes and the stored bound of block b:
//
//   - it is one of the stored bounds: blocks -1 to ceil((n - 1) / 2^m) where the map ends, else those
//     with nodes (src/unit/pyramid.rs);
//   - a surface over 2x2 nodes (r = 0) or 3x3 (r = 1) at the sample is made of nodes that lie, clamped
//     to the map as the height memory clamps them, in [(b - 1) 2^m - r, (b + 2) 2^m + r];
//   - where there is no bound, the sample is beside the map.
//
// Assumed is what the plan proves (equation 32): the place and the sample do not wrap.
module pyramid_axis_formal #(
    parameter int CELL  = 12,  // bits of a cell's index
    parameter int POINT = 20   // bits after the point
) (
    input  logic signed [CELL+POINT-1:0] place,          // where the jump starts
    input  logic signed [CELL+POINT-1:0] offset,         // from there to the sample
    input  logic        [      CELL-1:0] nodes,          // n
    input  logic                         ends,           // the map ends at its edge
    input  logic        [           4:0] level,          // m
    output logic                         cover_none,
    output logic                         cover_margin,   // a bound of a block beside the map
    output logic                         cover_reached,  // a node at the far end of the bound's reach
    output logic                         cover_edge      // beyond an edge that goes on
);
  localparam int R = CELL + 4;  // bits in which no index here wraps
  localparam int MOST = CELL - 1 < 20 ? CELL - 1 : 20;  // the highest level that is built

  logic signed [CELL-1:0] cell_index;
  logic [CELL-1:0] stored;
  logic none;
  assign cell_index = place[POINT+:CELL];
  pyramid_axis #(
      .CELL(CELL)
  ) axis (
      .nodes(nodes),
      .ends(ends),
      .level(level),
      .cell_index(cell_index),
      .stored(stored),
      .none(none)
  );

  // The sample, and the first and last node of its surface.
  logic signed [CELL+POINT:0] sample, most;
  logic signed [R-1:0] at, nearest, east;
  logic signed [R-1:0] first_2, last_2, first_3, last_3;
  assign most = (CELL + POINT + 1)'(1) << (level + 6'(POINT));
  assign sample = (CELL + POINT + 1)'(place) + (CELL + POINT + 1)'(offset);
  assign at = R'($signed(sample[CELL+POINT:POINT]));
  assign nearest = at + $signed({{(R - 1) {1'b0}}, sample[POINT-1]});
  assign east = $signed({4'b0, nodes}) - R'(1);
  assign first_2 = at < 0 ? '0 : at > east ? east : at;
  assign last_2 = at + 1 < 0 ? '0 : at + 1 > east ? east : at + 1;
  assign first_3 = nearest - 1 < 0 ? '0 : nearest - 1 > east ? east : nearest - 1;
  assign last_3 = nearest + 1 < 0 ? '0 : nearest + 1 > east ? east : nearest + 1;

  // The bound's block and reach.
  logic signed [R-1:0] block, size, low, high, blocks_end;
  assign size = R'(1) << level;
  assign block = $signed({4'b0, stored}) - (ends ? R'(1) : R'(0));
  assign low = (block - 1) <<< level;
  assign high = (block + 2) <<< level;
  assign blocks_end = ends ? (east + size - 1) >>> level : east >>> level;

  logic on_map;
  assign on_map = !ends || (at >= 0 && at < east);

  always_comb begin
    assume (nodes != 0 && nodes <= {1'b1, {(CELL - 1) {1'b0}}});
    assume (level <= 5'(MOST));
    assume (-most <= offset && offset <= most);
    assume (sample[CELL+POINT] == sample[CELL+POINT-1]);
    if (none) begin
      assert (!on_map);
    end else begin
      assert (block >= -(ends ? R'(1) : R'(0)) && block <= blocks_end);
      if (on_map) begin
        assert (low <= first_2 && last_2 <= high);
        assert (low - 1 <= first_3 && last_3 <= high + 1);
      end
    end
  end

  assign cover_none = none && level == 5'd3;
  assign cover_margin = !none && on_map && ends && block < 0 && level == 5'd2;
  assign cover_reached = !none && on_map && last_3 == high + 1 && level == 5'd2;
  assign cover_edge = !ends && cell_index > $signed({1'b0, nodes}) && level == 5'd2;
endmodule
