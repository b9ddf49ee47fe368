// The light: how much of it the surface of a height map reflects (equations 23 to 25 of
// docs/mathematics.md).
//
// The normal is shifted until its largest component is in [1/2, 1], squared and summed, normalised
// through a table of reciprocal square roots and multiplied with the light.
//
// Cycles: slopes of cycle t have their shade in cycle t + 11; one pixel per cycle. The stages, by
// the register that ends them:
//
// 1 | magnitudes of the slopes
// 2 | their leading one
// 3 | normal shifted, toward_y shifted
// 4 | rounded
// 5 | squares and dot product: sums of rows
// 6 | their sums
// 7 | entry of the table, read; dot product
// 8 | the entry's word
// 9 | dot product x table: sums of rows
// 10| their sum, rounded
// 11| ambient added, limited to one
//
// Ranges, with F = POINT; every multiplier and table is as wide as these ask for:
// - slopes: any word. Normal: |component| <= 1 by (23), F + 2 bits with sign. Its vertical component
//   is a power of two, so its square and its product with the light are shifts.
// - light: |toward| <= 1 per axis (a direction times the diffuse share), 0 <= ambient <= 1.
// - square sum < 3 by (23) and >= 1/4 - 2^-F: entries of the table up to 3 * 2^RSQRT_LOG2; those
//   from 4 * 2^RSQRT_LOG2 on are never read and not held. Table values <= 2, F + 2 bits.
// - dot product: |dot| <= 2.5 and two roundings, F + 3 bits with sign; times the table <= 5.1,
//   F + 4 bits with sign, with the ambient share <= 6.1.
//
// Rounding once before an addition of whole bits is rounding the sum: the sums behind products take
// the half bit and the other addend at once.
//
// Never divides; table and coefficients do not change while pixels are in it.
module light #(
    parameter int WIDE = 0,  // 0: words of 32 bits, 1: of 64
    parameter int RSQRT_LOG2 = 10,  // table entries per unit, as a power of two; even
    localparam int W = WIDE != 0 ? terraline_pkg::WIDE_WIDTH : terraline_pkg::NARROW_WIDTH,
    localparam int F = WIDE != 0 ? terraline_pkg::WIDE_POINT : terraline_pkg::NARROW_POINT
) (
    input logic clock,

    // Coefficients.
    input logic                lit,       // the light is fitted; without it shade is one
    input logic signed [W-1:0] toward_x,  // direction to the light times diffuse share, x
    input logic signed [W-1:0] toward_y,  // y
    input logic signed [W-1:0] toward_z,  // z
    input logic signed [W-1:0] ambient,   // ambient share

    // Table.
    input logic         load,          // write `load_data` to the reciprocal square roots
    input logic [ 15:0] load_address,  // entry
    input logic [W-1:0] load_data,     // tone word

    // Pixels.
    input  logic signed [W-1:0] slope_x,  // normal, x; its vertical component is one
    input  logic signed [W-1:0] slope_z,  // normal, z
    output logic        [  F:0] shade     // ambient and diffuse light, 0 .. 1, 11 cycles later
);
  localparam int SHIFT = $clog2(W - F + 1);  // bits of the normal's shift, 1 .. W - F
  localparam int TABLE = 4 << RSQRT_LOG2;  // entries of the table that are held
  localparam int UNIT = RSQRT_LOG2 + 2;  // bits of an entry's number

  // 1: magnitudes. That of the lowest word is itself, without sign.
  logic signed [W-1:0] slope_x_1, slope_z_1;
  logic [W-1:0] magnitudes_1;

  always_ff @(posedge clock) begin
    slope_x_1 <= slope_x;
    slope_z_1 <= slope_z;
    magnitudes_1 <= (slope_x < 0 ? -slope_x : slope_x)
                  | (slope_z < 0 ? -slope_z : slope_z);
  end

  // 2: places of the shift, the leading one's place above the point plus one.
  logic signed [W-1:0] slope_x_2, slope_z_2;
  logic signed [7:0] leading;
  logic [SHIFT-1:0] shift_2;

  leading_one #(
      .W(W - F)
  ) leading_slope (
      .word (magnitudes_1[W-1:F]),
      .place(leading)
  );

  always_ff @(posedge clock) begin
    slope_x_2 <= slope_x_1;
    slope_z_2 <= slope_z_1;
    shift_2   <= leading < 1 ? SHIFT'(1) : SHIFT'(leading) + SHIFT'(1);
  end

  // 3: the normal shifted; toward_y times its vertical component 2^-shift.
  logic [F+2:0] x_shifted, z_shifted, y_shifted, x_3, z_3, y_3;
  logic [SHIFT-1:0] shift_3;

  rescale_shift #(
      .IN(W),
      .OUT(F + 2),
      .PLACES(SHIFT)
  ) shift_x (
      .value (slope_x_2),
      .places(shift_2),
      .out   (x_shifted)
  );

  rescale_shift #(
      .IN(W),
      .OUT(F + 2),
      .PLACES(SHIFT)
  ) shift_z (
      .value (slope_z_2),
      .places(shift_2),
      .out   (z_shifted)
  );

  rescale_shift #(
      .IN(F + 2),
      .OUT(F + 2),
      .PLACES(SHIFT)
  ) shift_y (
      .value (toward_y[F+1:0]),
      .places(shift_2),
      .out   (y_shifted)
  );

  always_ff @(posedge clock) begin
    x_3 <= x_shifted;
    z_3 <= z_shifted;
    y_3 <= y_shifted;
    shift_3 <= shift_2;
  end

  // 4: rounded. The vertical component is below the last bit from a shift of F + 1 on: no
  // light from above.
  logic signed [F+1:0] x_4, z_4, light_y_4;
  logic [SHIFT-1:0] shift_4;

  always_ff @(posedge clock) begin
    x_4 <= x_3[F+2:1] + (F + 2)'(x_3[0]);
    z_4 <= z_3[F+2:1] + (F + 2)'(z_3[0]);
    light_y_4 <= 32'(shift_3) > F ? '0 : y_3[F+2:1] + (F + 2)'(y_3[0]);
    shift_4 <= shift_3;
  end

  // 5 and 6: squares and products with the light. The square of the vertical component is
  // 2^-2shift, or nothing below the last bit; beside it stands the half entry of the table's address.
  logic [2*F+3:0] square_x, square_z, square_x_6, square_z_6;
  logic signed [2*F+3:0] dot_x, dot_z, dot_x_6, dot_z_6;
  logic signed [F+1:0] light_y_5, light_y_6;
  logic [SHIFT-1:0] shift_5;
  logic [F-1:0] square_y, square_y_6;

  square #(
      .A(F + 2)
  ) square_of_x (
      .clock(clock),
      .a(x_4),
      .p(square_x)
  );

  square #(
      .A(F + 2)
  ) square_of_z (
      .clock(clock),
      .a(z_4),
      .p(square_z)
  );

  product #(
      .A(F + 2),
      .B(F + 2)
  ) multiply_dot_x (
      .clock(clock),
      .a(x_4),
      .b(toward_x[F+1:0]),
      .result(dot_x)
  );

  product #(
      .A(F + 2),
      .B(F + 2)
  ) multiply_dot_z (
      .clock(clock),
      .a(z_4),
      .b(toward_z[F+1:0]),
      .result(dot_z)
  );

  always_comb begin
    square_y = '0;
    for (int at = 1; at <= F / 2; at++) if (32'(shift_5) == at) square_y[F-2*at] = 1'b1;
    square_y[F-RSQRT_LOG2-1] = 1'b1;
  end

  always_ff @(posedge clock) begin
    light_y_5 <= light_y_4;
    shift_5 <= shift_4;
    square_x_6 <= square_x;
    square_z_6 <= square_z;
    dot_x_6 <= dot_x;
    dot_z_6 <= dot_z;
    light_y_6 <= light_y_5;
    square_y_6 <= square_y;
  end

  // 7 and 8: the table's entry is read, and stands in a register; the dot product.
  localparam logic [F-1:0] HALF = F'(1) << (F - 1);

  logic [F+1:0] rsqrt[TABLE];
  logic [F+1:0] rsqrt_7, rsqrt_8;
  logic [2*F+3:0] square_sum;
  logic [UNIT-1:0] entry;
  logic signed [2*F+3:0] dot;
  logic signed [F+2:0] dot_7, dot_8;

  assign square_sum = square_x_6 + square_z_6 + {4'b0, square_y_6, HALF};
  assign entry = square_sum[2*F+1:2*F-RSQRT_LOG2];
  assign dot = dot_x_6 + dot_z_6 + $signed({{2{light_y_6[F+1]}}, light_y_6, HALF});

  always_ff @(posedge clock) begin
    if (load && 32'(load_address) < TABLE) rsqrt[load_address[UNIT-1:0]] <= load_data[F+1:0];
    rsqrt_7 <= rsqrt[entry];
    rsqrt_8 <= rsqrt_7;
    dot_7   <= dot[2*F+2:F];
    dot_8   <= dot_7;
  end

  // 9 and 10: divided by the length of the normal. Light from behind is none.
  logic signed [2*F+5:0] diffuse;
  logic signed [2*F+5:0] diffuse_half;
  logic lit_9;
  logic [F+2:0] diffuse_10;

  product #(
      .A(F + 3),
      .B(F + 3)
  ) multiply_diffuse (
      .clock(clock),
      .a(dot_8),
      .b($signed({1'b0, rsqrt_8})),
      .result(diffuse)
  );

  assign diffuse_half = diffuse + $signed({{(F + 6) {1'b0}}, HALF});

  always_ff @(posedge clock) begin
    lit_9 <= dot_8 > 0;
    diffuse_10 <= lit_9 ? diffuse_half[2*F+2:F] : '0;
  end

  // 11: shade, at most one.
  localparam logic [F:0] ONE = (F + 1)'(1) << F;

  logic [F+2:0] sum;

  assign sum = diffuse_10 + {2'b0, ambient[F:0]};

  always_ff @(posedge clock) shade <= !lit || sum > {2'b0, ONE} ? ONE : sum[F:0];
endmodule
