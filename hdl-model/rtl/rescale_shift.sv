// The shift of a value on its way into another register, without the rounding: the low OUT + 1 bits
// of `floor(value · 2^(LEFT + 1 - places))`. The lowest of them is the bit below the result, so that
// rounding half up is `out[OUT:1] + out[0]`, an addition of the next stage.
//
// A barrel shifter: no clock. Shifts beyond the word leave its sign, which rounds to zero.
// SUM = IN + LEFT + 1 is at least OUT + 1.
module rescale_shift #(
    parameter int IN     = 32,  // bits of the value
    parameter int OUT    = 22,  // bits of the result
    parameter int LEFT   = 0,   // largest shift to the left
    parameter int PLACES = 8    // bits of `places`
) (
    input  logic signed [    IN-1:0] value,   // what is shifted
    input  logic        [PLACES-1:0] places,  // LEFT minus the exponent
    output logic        [     OUT:0] out      // the result, and below it the rounding bit
);
  localparam int SUM = IN + LEFT + 1;

  logic signed [SUM-1:0] from, shifted;

  assign from    = {value, {(LEFT + 1) {1'b0}}};
  assign shifted = from >>> places;
  assign out     = shifted[OUT:0];
endmodule
