// The pixel: the bytes that the frame takes (docs/units/pixel.md). The lit colour is rounded where the
// surface is met; sky, out of range and the side of the map have constant colours.
//
// The two roundings, to a word and to a byte, are one:
// floor((floor((p + 2^(F-1)) / 2^F) + 2^(F-1)) / 2^F) = floor((p + 2^(2F-1) + 2^(F-1)) / 2^(2F)).
//
// No clock. Lit channels are in [0, 255].
module pixel #(
    parameter int WIDE = 0,  // 0: words of 32 bits, 1: of 64
    localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT
) (
    // Coefficients.
    input  logic [           23:0] sky_color,           // colours, red in the low byte: nothing is met
    input  logic [           23:0] out_of_range_color,  // out of range
    input  logic [           23:0] side_color,          // the side of the map
    // Pixels.
    input  logic [            1:0] hit,                 // 0 sky, 1 surface, 2 side, 3 out of range
    input  logic [ 3*(2*F+11)-1:0] lit,                 // channels, red lowest, 2F bits behind the point
    output logic [           23:0] color                // sRGB bytes, red in the low byte
);
  // Half of a word's last bit and half a level.
  localparam logic [2*F-1:0] HALVES = (2 * F)'(1) << (2 * F - 1) | (2 * F)'(1) << (F - 1);

  logic [23:0] nearest;

  for (genvar channel = 0; channel < 3; channel++) begin : gen_channel
    logic [2*F+10:0] sum;

    assign sum = lit[(2*F+11)*channel+:2*F+11] + {11'b0, HALVES};
    assign nearest[8*channel+:8] = sum[2*F+:8];
  end

  always_comb begin
    case (hit)
      2'd0: color = sky_color;
      2'd1: color = nearest;
      2'd2: color = side_color;
      default: color = out_of_range_color;
    endcase
  end
endmodule
