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
  // A constant: Yosys 0.23 takes -N'(x) for (-N)'(x).
  localparam logic signed [CELL:0] MARGIN = -1;

  // Where the map ends, blocks -1 to ceil((nodes - 1) / 2^m) are stored, else those with nodes.
  logic signed [CELL:0] block, last;
  logic [CELL:0] edge_cell, rounded;

  assign block = (CELL + 1)'(cell_index) >>> level;
  assign edge_cell = {1'b0, nodes} - (CELL + 1)'(1);
  assign rounded = edge_cell + ((CELL + 1)'(1) << level) - (CELL + 1)'(1);
  assign last = $signed((ends ? rounded : edge_cell) >> level);

  always_comb begin
    none = 1'b0;
    if (ends) begin
      none   = block < MARGIN || block > last;
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
