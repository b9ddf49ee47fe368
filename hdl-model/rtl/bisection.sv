// How many bisection steps refine a hit, from the largest component of its distance from the eye
// (equation 22).
//
// `any` is that of the place of the cycle before, `times` that of two cycles before: whether there are
// bisection steps at all is needed at once, how many only with the first answer.
module bisection #(
    parameter int W     = 32,  // bits of a word
    parameter int POINT = 20   // bits after the point
) (
    input  logic                clock,
    // Coefficients
    input  logic signed [W-1:0] eye_x,   // the eye, x in cells
    input  logic signed [W-1:0] eye_y,   // y in height units
    input  logic signed [W-1:0] eye_z,   // z in cells
    input  logic                fixed,   // always `cap` bisection steps
    input  logic signed [  7:0] bias,    // bisection steps at distance one
    input  logic        [  5:0] cap,     // most bisection steps
    // The hit
    input  logic signed [W-1:0] x,       // place, x
    input  logic signed [W-1:0] y,       // height
    input  logic signed [W-1:0] z,       // place, z
    output logic                any,     // there are some
    output logic        [  5:0] times    // how many, where there are some
);
  // The leading one of the largest component is that of all together.
  logic signed [W-1:0] away_x, away_y, away_z, toward_x, toward_y, toward_z;
  logic [W-1:0] distance;
  logic signed [7:0] leading, leading_2;

  assign away_x = x - eye_x;
  assign away_y = y - eye_y;
  assign away_z = z - eye_z;
  assign toward_x = eye_x - x;
  assign toward_y = eye_y - y;
  assign toward_z = eye_z - z;
  leading_one #(
      .W(W)
  ) leading_away (
      .word(distance),
      .place(leading)
  );

  // Of coefficients alone: bisection steps where the leading one is in the last place, places from which on
  // there are none, and whether there are none at all.
  logic signed [9:0] reach, wanted;
  logic [W-1:0] beyond;
  logic never;

  assign reach = 10'(bias) + 10'(POINT);
  always_ff @(posedge clock) begin
    for (int at = 0; at < W; at++) beyond[at] <= reach <= $signed(10'(at));
    never <= cap == '0 || (!fixed && reach < 0);
  end

  always_ff @(posedge clock) begin
    distance <= (away_x < 0 ? toward_x : away_x) | (away_y < 0 ? toward_y : away_y)
              | (away_z < 0 ? toward_z : away_z);
    leading_2 <= leading;
  end
  assign any = !never && (fixed || (distance & beyond) == '0);
  assign wanted = reach - 10'(leading_2);
  assign times = fixed || wanted > $signed({4'b0, cap}) ? cap : wanted[5:0];
endmodule
