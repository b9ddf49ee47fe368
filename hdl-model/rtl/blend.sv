// Weight and fall of one axis over 2×2 nodes: the kernel's, the hat's, or the hat's plus the
// difference to the kernel shifted right (equation 16 of docs/mathematics.md). No cycles.
//
// The fall is the negated derivative of the weight, which the hat has one of. The shift rounds
// toward zero: a floor would leave −1 ulp of a negative difference however far it is shifted.
module blend #(
    parameter int POINT = 20  // fraction bits of a weight
) (
    input  logic [      1:0] form,      // 0 the kernel, 1 blend, 2 the hat
    input  logic [      5:0] shift,     // of the difference; from the width of a word on, none is left
    input  logic [POINT-1:0] fraction,  // of the place in its cell
    input  logic [  POINT:0] kernel,    // the kernel's weight, in [0, 1]
    input  logic [POINT+2:0] slope,     // the kernel's derivative, signed, in (−4, 4)
    output logic [  POINT:0] weight,    // of the lower node, in [0, 1]
    output logic [POINT+2:0] fall       // negated derivative of the weight, signed
);
  localparam logic [POINT:0] ONE = {1'b1, {POINT{1'b0}}};
  localparam int D = POINT + 4;
  logic [POINT:0] hat;
  logic [D-1:0] beyond, steeper;

  function automatic logic [D-1:0] toward_zero(input logic [D-1:0] value, input logic [5:0] places);
    logic lost;
    lost = |(value & ~({D{1'b1}} << places));
    toward_zero = $unsigned($signed(value) >>> places) + {{(D - 1) {1'b0}}, value[D-1] & lost};
  endfunction

  assign hat     = ONE - {1'b0, fraction};
  assign beyond  = toward_zero({3'b0, kernel} - {3'b0, hat}, shift);
  assign steeper = toward_zero({slope[POINT+2], slope} + {3'b0, ONE}, shift);

  always_comb begin
    case (form)
      2'd0: begin
        weight = kernel;
        fall   = -slope;
      end
      2'd1: begin
        weight = hat + (POINT + 1)'(beyond);
        fall   = {2'b0, ONE} - (POINT + 3)'(steeper);
      end
      default: begin
        weight = hat;
        fall   = {2'b0, ONE};
      end
    endcase
  end
endmodule
