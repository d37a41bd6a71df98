# Effects on samples from matt to mirror: $effects, a group of rows (number of the sample, effect /
# GU) for each of `count` quantities; `samples` is how many samples there are.
set xlabel "sample, from matt to mirror"
set ylabel "largest effect within the limits / GU"
set xrange [0.5:samples + 0.5]
set xtics 1
set yrange [y_low:y_high]
set format y "%g"
plot NaN notitle, for [i = 1:count] $effects index i - 1 using 1:2 with linespoints lt i ps 0.8 \
     title sprintf("%d", i)
