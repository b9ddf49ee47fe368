// One axis of the skip pyramid's addresses.
module pyramid_axis #(
    parameter int CELL = 12  // bits of a cell's index
) (
    input  logic        [CELL-1:0] nodes,       // nodes of the map on this axis
    input  logic                   ends,        // the map ends at its edge, else its edge goes on
    input  logic        [     4:0] level,       // m: blocks of 2^m cells
    input  logic signed [CELL-1:0] cell_index,  // cell of the ray
    output logic        [CELL-1:0] stored,      // index of the stored bound
    output logic                   none         // there is none
);
  // Where the map ends, blocks -1 to ceil((nodes - 1) / 2^m) are stored, else those with nodes. A cell
  // is beyond the last of these if even the block before it begins at the last node or behind:
  // no shift of `nodes` is needed to know that there is no bound.
  localparam int C = CELL + 2;
  logic signed [C-1:0] block, last, edge_cell, size, low_bits, beginning;

  assign edge_cell = $signed({2'b0, nodes}) - C'(1);
  assign block = C'(cell_index) >>> level;
  assign last = edge_cell >>> level;
  always_comb begin
    for (int at = 0; at < C; at++) begin
      size[at] = 32'(level) == at;
      low_bits[at] = 32'(level) > at;
    end
  end
  assign beginning = C'(cell_index) & ~low_bits;

  always_comb begin
    none = 1'b0;
    if (ends) begin
      none   = C'(cell_index) + size < 0 || beginning >= edge_cell + size;
      stored = CELL'(block) + CELL'(1);
    end else if (block < 0) begin
      stored = '0;
    end else if (block > last) begin
      stored = CELL'(last);
    end else begin
      stored = CELL'(block);
    end
  end
endmodule
