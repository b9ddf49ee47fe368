// Weight and fall of one axis over 2×2 nodes: the hat's, plus the difference to the kernel shifted
// right (equation 16 of docs/mathematics.md; thesis 2.59 to 2.61). Two cycles: differences, then
// shifts and sums.
//
// The fall is the negated derivative of the weight, which the hat has one of. The shift rounds
// toward zero: a floor would leave −1 ulp of a negative difference however far it is shifted. A
// difference that is not shifted gives the kernel itself, one that is shifted away the hat.
module hat_weight #(
    parameter int POINT = 20  // fraction bits of a weight
) (
    input  logic             clock,
    input  logic [      1:0] form,      // 0 the kernel, 1 toward the hat, 2 the hat
    input  logic [      5:0] shift,     // of the difference; from the width of a word on, none is left
    input  logic [POINT-1:0] fraction,  // of the place in its cell
    input  logic [  POINT:0] kernel,    // the kernel's weight, in [0, 1]
    input  logic [POINT+2:0] slope,     // the kernel's derivative, signed, in (−4, 4)
    output logic [  POINT:0] weight,    // of the lower node, in [0, 1]; in the cycle after
    output logic [POINT+2:0] fall       // negated derivative of the weight, signed
);
  localparam logic [POINT:0] ONE = {1'b1, {POINT{1'b0}}};
  logic [5:0] places;
  logic [POINT:0] hat, hat_1;
  logic signed [POINT+1:0] beyond, beyond_lost;
  logic signed [POINT+3:0] steeper, steeper_lost;

  assign hat = ONE - {1'b0, fraction};

  always_ff @(posedge clock) begin
    places <= form == 2'd0 ? '0 : form == 2'd1 ? shift : '1;
    hat_1 <= hat;
    beyond <= $signed({1'b0, kernel}) - $signed({1'b0, hat});
    steeper <= $signed({slope[POINT+2], slope}) + $signed({3'b0, ONE});
  end

  // What the shift loses of a negative difference is one more.
  assign beyond_lost = beyond & ~({(POINT + 2) {1'b1}} << places);
  assign steeper_lost = steeper & ~({(POINT + 4) {1'b1}} << places);
  assign weight = hat_1 + (POINT + 1)'(beyond >>> places)
      + {{POINT{1'b0}}, beyond < 0 && beyond_lost != '0};
  assign fall = {2'b0, ONE} - (POINT + 3)'(steeper >>> places)
      - {{(POINT + 2) {1'b0}}, steeper < 0 && steeper_lost != '0};
endmodule
