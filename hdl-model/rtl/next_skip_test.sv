// What follows in a walk: a jump over a bound of the pyramid, or a burst of samples (equation 21). A
// jump of level m takes 2^(m + k) steps, which must not pass the last sample.
module next_skip_test (
    // Coefficients
    input  logic [ 2:0] fineness,   // k: steps of at most 2^-k cells
    input  logic        skipping,   // the pyramid is fitted
    // The walk
    input  logic [25:0] remaining,  // samples up to the last one
    output logic        jump,       // a jump of level 0 fits
    output logic [ 6:0] run         // samples of a burst, at most 2^6
);
  logic [6:0] burst;

  assign burst = skipping ? 7'd1 << fineness : 7'd1;
  assign jump = skipping && remaining >= 26'(burst);
  assign run = remaining >= 26'(burst) ? burst : remaining[6:0];
endmodule
