// Height and slopes between 2×2 nodes (equations 14 and 15 of docs/mathematics.md; thesis 2.51,
// 2.52).
//
// Operands in cycle t give their results in cycle t + 5, one set per cycle: differences, two stages
// of products along one axis, two along the other. Each lerp rounds its exact product once. Words
// wrap; differences of heights are taken to fit a word and not to be its smallest value, which the
// plan proves, as heights are not negative. Three products, with slopes seven.
module patch_2x2 #(
    parameter int WIDE   = 0,  // 0: 32-bit words, 1: 64-bit words
    parameter int SLOPES = 1   // 1: slopes as well
) (
    input  logic                             clock,
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h1,        // node (i, j)
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h2,        // node (i, j + 1)
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h3,        // node (i + 1, j)
    input  logic [(WIDE != 0 ? 64 : 32)-1:0] h4,        // node (i + 1, j + 1)
    input  logic [   WIDE != 0 ? 24 : 20:0] weight_x,  // of column i, in [0, 1]
    input  logic [   WIDE != 0 ? 24 : 20:0] weight_z,  // of row j
    input  logic [   WIDE != 0 ? 26 : 22:0] fall_x,    // negated derivative of weight_x, signed
    input  logic [   WIDE != 0 ? 26 : 22:0] fall_z,
    output logic [(WIDE != 0 ? 64 : 32)-1:0] surface,   // five cycles later
    output logic [(WIDE != 0 ? 64 : 32)-1:0] slope_x,   // −∂y/∂x, height units per cell
    output logic [(WIDE != 0 ? 64 : 32)-1:0] slope_z    // −∂y/∂z
);
  localparam int W = WIDE != 0 ? 64 : 32;
  localparam int POINT = WIDE != 0 ? 24 : 20;
  localparam int T = POINT + 1;  // bits of a weight
  localparam int S = POINT + 3;  // bits of a fall

  // Along z: west is the height between h1 and h2, east between h3 and h4.
  logic [W-1:0] west_difference, west_base, west_base_2, west;
  logic [W-1:0] east_difference, east_base, east_base_2, east;
  logic [T-1:0] weight_x_1, weight_x_2, weight_x_3, weight_z_1;
  logic [W+T-1:0] west_product, east_product;

  always_ff @(posedge clock) begin
    west_difference <= h1 - h2;
    west_base       <= h2;
    west_base_2     <= west_base;
    east_difference <= h3 - h4;
    east_base       <= h4;
    east_base_2     <= east_base;
    weight_z_1      <= weight_z;
    weight_x_1      <= weight_x;
    weight_x_2      <= weight_x_1;
    weight_x_3      <= weight_x_2;
  end
  product #(.A(W), .B(T), .SIGNED(0)) west_multiplier (
      .clock(clock), .a(west_difference), .b(weight_z_1), .result(west_product));
  product #(.A(W), .B(T), .SIGNED(0)) east_multiplier (
      .clock(clock), .a(east_difference), .b(weight_z_1), .result(east_product));
  rounded #(.W(W), .SUM(W + T), .POINT(POINT)) west_lerp (
      .sum(west_product), .base(west_base_2), .result(west));
  rounded #(.W(W), .SUM(W + T), .POINT(POINT)) east_lerp (
      .sum(east_product), .base(east_base_2), .result(east));

  // Along x.
  logic [W-1:0] difference, base, base_4, height;
  logic [W+T-1:0] height_product;

  always_ff @(posedge clock) begin
    difference <= west - east;
    base       <= east;
    base_4     <= base;
    surface    <= height;
  end
  product #(.A(W), .B(T), .SIGNED(0)) multiplier (
      .clock(clock), .a(difference), .b(weight_x_3), .result(height_product));
  rounded #(.W(W), .SUM(W + T), .POINT(POINT)) lerp (
      .sum(height_product), .base(base_4), .result(height));

  generate
    if (SLOPES != 0) begin : gen_slopes
      // The same along the other axis: north is the height between h1 and h3, south between h2
      // and h4.
      logic [W-1:0] north_difference, north_base, north_base_2, north;
      logic [W-1:0] south_difference, south_base, south_base_2, south;
      logic [W+T-1:0] north_product, south_product;
      logic [S-1:0] fall_x_1, fall_x_2, fall_x_3, fall_z_1, fall_z_2, fall_z_3;

      always_ff @(posedge clock) begin
        north_difference <= h1 - h3;
        north_base       <= h3;
        north_base_2     <= north_base;
        south_difference <= h2 - h4;
        south_base       <= h4;
        south_base_2     <= south_base;
        fall_x_1         <= fall_x;
        fall_x_2         <= fall_x_1;
        fall_x_3         <= fall_x_2;
        fall_z_1         <= fall_z;
        fall_z_2         <= fall_z_1;
        fall_z_3         <= fall_z_2;
      end
      product #(.A(W), .B(T), .SIGNED(0)) north_multiplier (
          .clock(clock), .a(north_difference), .b(weight_x_1), .result(north_product));
      product #(.A(W), .B(T), .SIGNED(0)) south_multiplier (
          .clock(clock), .a(south_difference), .b(weight_x_1), .result(south_product));
      rounded #(.W(W), .SUM(W + T), .POINT(POINT)) north_lerp (
          .sum(north_product), .base(north_base_2), .result(north));
      rounded #(.W(W), .SUM(W + T), .POINT(POINT)) south_lerp (
          .sum(south_product), .base(south_base_2), .result(south));

      logic [W-1:0] difference_z, fall_along_x, fall_along_z;
      logic [W+S-1:0] x_product, z_product;

      always_ff @(posedge clock) begin
        difference_z <= north - south;
        slope_x      <= fall_along_x;
        slope_z      <= fall_along_z;
      end
      product #(.A(W), .B(S)) x_multiplier (
          .clock(clock), .a(difference), .b(fall_x_3), .result(x_product));
      product #(.A(W), .B(S)) z_multiplier (
          .clock(clock), .a(difference_z), .b(fall_z_3), .result(z_product));
      rounded #(.W(W), .SUM(W + S), .POINT(POINT)) x_slope (
          .sum(x_product), .base({W{1'b0}}), .result(fall_along_x));
      rounded #(.W(W), .SUM(W + S), .POINT(POINT)) z_slope (
          .sum(z_product), .base({W{1'b0}}), .result(fall_along_z));
    end else begin : gen_no_slopes
      assign slope_x = '0;
      assign slope_z = '0;
    end
  endgenerate
endmodule
