// A jump's bound covers every node that a sample of the jump is made of (equation 21), for every level,
// map and place, one axis. The box of a bound is the product of its axes.
//
// A jump of level m covers at most 2^m cells: J = 2^(m+k) steps of at most 2^-k cells. 2^m is a whole
// number, so the cells of its samples are at most 2^m cells from the cell where it starts. Any such
// cell is a sample's here: this holds for jumps of any length. To show, for a map of n nodes and the
// stored bound of block b:
//
//   - it is one of the stored bounds: blocks -1 to ceil((n - 1) / 2^m) where the map ends, else those
//     with nodes (src/unit/pyramid.rs);
//   - a surface over 2x2 nodes (r = 0) or 3x3 (r = 1) at the sample is made of nodes that lie, clamped
//     to the map as the height memory clamps them, in [(b - 1) 2^m - r, (b + 2) 2^m + r];
//   - where there is no bound, the sample is beside the map.
//
// Assumed is what the plan proves (equation 32): the sample does not wrap.
module pyramid_axis_formal #(
    parameter int CELL  = 12,  // bits of a cell's index
    parameter int LEVEL = 0    // m, up to the highest level that is built
) (
    input  logic signed [CELL-1:0] cell_index,     // cell where the jump starts
    input  logic signed [CELL-1:0] sample_cell,    // cell of the sample
    input  logic                   upper_half,     // the sample is nearer to the node after its cell
    input  logic        [CELL-1:0] nodes,          // n
    input  logic                   ends,           // the map ends at its edge
    output logic                   cover_none,     // cases that must be possible: no bound
    output logic                   cover_margin,   // a bound of a block beside the map
    output logic                   cover_reached,  // a node at the far end of the bound's reach
    output logic                   cover_edge      // beyond an edge that goes on
);
  localparam int R = CELL + 4;  // bits in which no index here wraps
  localparam logic signed [R-1:0] ONE = 1;

  logic [CELL-1:0] stored;
  logic none;
  pyramid_axis #(
      .CELL(CELL)
  ) axis (
      .nodes(nodes),
      .ends(ends),
      .level(5'(LEVEL)),
      .cell_index(cell_index),
      .stored(stored),
      .none(none)
  );

  // The sample, and the first and last node of its surface.
  logic signed [R-1:0] from, at, nearest, size, east;
  logic signed [R-1:0] first_2, last_2, first_3, last_3;
  assign from = R'(cell_index);
  assign at = R'(sample_cell);
  assign nearest = upper_half ? at + ONE : at;
  assign size = ONE << LEVEL;
  assign east = $signed({4'b0, nodes}) - ONE;
  assign first_2 = at < 0 ? '0 : at > east ? east : at;
  assign last_2 = at + ONE < 0 ? '0 : at + ONE > east ? east : at + ONE;
  assign first_3 = nearest - ONE < 0 ? '0 : nearest - ONE > east ? east : nearest - ONE;
  assign last_3 = nearest + ONE < 0 ? '0 : nearest + ONE > east ? east : nearest + ONE;

  // The bound's block and reach, and the last stored block.
  logic signed [R-1:0] block, low, high, last_block;
  assign block = ends ? $signed({4'b0, stored}) - ONE : $signed({4'b0, stored});
  assign low = (block - ONE) <<< LEVEL;
  assign high = (block + ONE + ONE) <<< LEVEL;
  assign last_block = ends ? (east + size - ONE) >>> LEVEL : east >>> LEVEL;

  logic on_map;
  assign on_map = !ends || (at >= 0 && at < east);

  always_comb begin
    assume (nodes != 0 && nodes <= {1'b1, {(CELL - 1) {1'b0}}});
    assume (from - size <= at && at <= from + size);
    if (none) begin
      assert (!on_map);
    end else begin
      assert ((ends ? -ONE : 0) <= block && block <= last_block);
      if (on_map) begin
        assert (low <= first_2 && last_2 <= high);
        assert (low - ONE <= first_3 && last_3 <= high + ONE);
      end
    end
  end

  assign cover_none = none;
  assign cover_margin = !none && on_map && ends && block < 0;
  assign cover_reached = !none && on_map && last_3 == high + ONE;
  assign cover_edge = !ends && from > east;
endmodule
