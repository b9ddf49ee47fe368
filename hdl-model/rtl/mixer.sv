// The mixer: the lit colour of the ground, albedo times shade (docs/units/mixer.md). Texture layers
// enter before it, into `albedo`, and occlusion into `shade`.
//
// Cycles: channels of cycle t have their products in cycle t + 1, out of adders; one pixel per cycle.
// Albedo is in [0, 255], shade in [0, 1]. Products are exact: who takes them rounds them.
module mixer #(
    parameter int WIDE = 0,  // 0: words of 32 bits, 1: of 64
    localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT
) (
    input  logic                   clock,
    input  logic [    3*(F+9)-1:0] albedo,     // channels, signed, red lowest
    input  logic [            F:0] shade,      // 0 .. 1
    output logic [ 3*(2*F+11)-1:0] lit         // channels times shade, 2F bits behind the point
);
  for (genvar channel = 0; channel < 3; channel++) begin : gen_channel
    product #(
        .A(F + 9),
        .B(F + 2)
    ) multiply_shade (
        .clock(clock),
        .a(albedo[(F+9)*channel+:F+9]),
        .b({1'b0, shade}),
        .result(lit[(2*F+11)*channel+:2*F+11])
    );
  end
endmodule
