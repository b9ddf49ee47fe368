// Whether a ray at a place can no longer meet the map: above the highest node and rising, under the
// base and falling, or outside the map and receding (the conditions under equation 21).
module ray_end #(
    parameter int W = 32,    // bits of a word
    parameter int CELL = 12  // bits of a cell's index
) (
    // Coefficients
    input  logic signed [   W-1:0] highest,      // the highest node
    input  logic signed [   W-1:0] base,         // base of the block under the map
    input  logic signed [CELL-1:0] east,         // cells in x
    input  logic signed [CELL-1:0] south,        // cells in z
    input  logic                   map_ends,     // the map ends at its edge
    input  logic                   sides,        // the map has sides, down to the base
    // The ray
    input  logic signed [CELL-1:0] i,            // cell, x
    input  logic signed [   W-1:0] y,            // height
    input  logic signed [CELL-1:0] j,            // cell, z
    input  logic        [     2:0] forward,      // bits x, y, z: the step is not negative
    input  logic        [     2:0] backward,     // bits x, y, z: the step is not positive
    output logic                   over          // nothing can be met any more
);
  assign over = (forward[1] && y >= highest) || (sides && backward[1] && y < base)
      || (map_ends && ((backward[0] && i < 0) || (forward[0] && i >= east)
      || (backward[2] && j < 0) || (forward[2] && j >= south)));
endmodule
