//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿Input< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric#######��t< super﻿ ############################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricIn 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿Input< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file wiistoricInput< 'file withAHistoric###################################��t< super﻿ and
//! AHistoricInput< 'filInput< 'filInput< 'file withAHistoric###################################��t< super﻿ and
#####