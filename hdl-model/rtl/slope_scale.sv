// Slopes of cells that are not cubes of the height unit (equation 18 of docs/mathematics.md): two
// products, or none, in two cycles. Takes one pair every cycle.
module slope_scale #(
    parameter int WIDE = 0  // 0: 32-bit words, 1: 64-bit words
) (
    input  logic                             clock,
    input  logic                             scaled,   // slopes are scaled; else delayed only
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] scale_x,  // height unit over cell, a signed weight
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] scale_z,
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] slope_x,  // height units per cell
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] slope_z,
    output logic [(WIDE != 0 ? 64 : 32)-1:0] out_x,    // scene units per scene unit, two cycles later
    output logic [(WIDE != 0 ? 64 : 32)-1:0] out_z
);
  localparam int W = WIDE != 0 ? 64 : 32;
  localparam int POINT = WIDE != 0 ? 24 : 20;
  logic [2*W-1:0] product_x, product_z;
  logic [W-1:0] scaled_x, scaled_z, slope_x_1, slope_z_1;

  product #(.A(W), .B(W)) multiplier_x (
      .clock(clock), .a(slope_x), .b(scale_x), .result(product_x));
  product #(.A(W), .B(W)) multiplier_z (
      .clock(clock), .a(slope_z), .b(scale_z), .result(product_z));
  rounded #(.W(W), .SUM(2 * W), .POINT(POINT)) round_x (
      .sum(product_x), .base({W{1'b0}}), .result(scaled_x));
  rounded #(.W(W), .SUM(2 * W), .POINT(POINT)) round_z (
      .sum(product_z), .base({W{1'b0}}), .result(scaled_z));

  always_ff @(posedge clock) begin
    slope_x_1 <= slope_x;
    slope_z_1 <= slope_z;
    out_x     <= scaled ? scaled_x : slope_x_1;
    out_z     <= scaled ? scaled_z : slope_z_1;
  end
endmodule
