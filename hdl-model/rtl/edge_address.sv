// Addresses of two neighbouring nodes along one axis of the height memory: index and index + 1,
// either of them clamped to the axis, in the banks of even and of odd nodes. No cycles.
//
// Both banks are read inside the axis even where both nodes are the same one. On an axis of one
// node the bank of odd nodes is empty: its address is 0, and its answer is not used.
module edge_address #(
    parameter int CELL = 12  // bits of a cell index
) (
    input  logic [CELL+1:0] index,       // of the lower node, signed
    input  logic [CELL-1:0] size,        // nodes of the axis, 1 to 2^(CELL-1)
    output logic [CELL-2:0] even,        // address in the bank of even nodes
    output logic [CELL-2:0] odd,         // address in the bank of odd nodes
    output logic            lower_odd,   // the node at `index` is odd
    output logic            upper_odd    // the node at `index` + 1 is odd
);
  logic [CELL-1:0] last, base;
  logic below, above, single;

  assign last   = size - CELL'(1);
  assign single = last == '0;
  assign below = index[CELL+1];
  assign above = !below && index >= {2'b0, last};

  // The pair that is read is base and base + 1.
  assign base = below || single ? '0 : above ? last - CELL'(1) : index[CELL-1:0];

  // Bit CELL - 1 of a base is zero.
  assign odd       = (CELL - 1)'(base >> 1);
  assign even      = (CELL - 1)'(base >> 1) + {{(CELL - 2) {1'b0}}, base[0]};
  assign lower_odd = base[0] ^ (above && !single);
  assign upper_odd = base[0] ^ !(below || single);
endmodule
