$aligned#define ${OF}ANCHORS $anchor_count
#define ${OF}FEATURES $feature_count
#define ${OF}INPUTS $input_count
#define ${OF}NOISE_AXES $noise_count /* 0: the networks see features as they are */
#define ${OF}HIDDEN $hidden_count
#define ${OF}CONNECTIONS $connection_count
