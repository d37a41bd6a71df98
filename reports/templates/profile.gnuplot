# In-plane profiles: $curves, a group of rows (angle / deg, density) for each of `count`; $fields,
# rows (low, high / deg) of what is shaded where `has_fields`.
set terminal svg size 720,420 font "sans-serif,13" background "#ffffff"
set xlabel "angle from the mirror direction / deg"
set ylabel "GU per degree"
set logscale y
set format y "10^{%L}"
set xrange [-reach:reach]
set yrange [y_low:y_high]
plot NaN notitle, \
     for [i = 1:has_fields] $fields using (0.5 * ($1 + $2)):(y_low):1:2:(y_low):(y_high) with boxxyerror fc rgb "#e3e8d0" fs solid 0.6 border lc rgb "#b9c298" notitle, \
     for [i = 1:count] $curves index i - 1 using 1:2 with lines lt i title sprintf("%d", i)
